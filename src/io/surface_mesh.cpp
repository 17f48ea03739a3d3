#include "surface_mesh.hpp"

#include <algorithm>

namespace skein {
namespace {

using Quad = std::array<std::int32_t, 4>;

// Node 0 sees the rest of the section two edges at a time; `reversed` where outside lies behind the first section.
void add_cap(const int first, const int n, const bool reversed, std::vector<Quad>& quads) {
  for (int a = 1; a + 1 < n; a += 2) {
    const int b = a + 1;
    const int c = std::min(a + 2, n - 1);
    if (reversed)
      quads.push_back({first, first + c, first + b, first + a});
    else
      quads.push_back({first, first + a, first + b, first + c});
  }
}

}  // namespace

std::vector<Quad> make_surface_mesh(const std::vector<Fiber>& fibers) {
  std::vector<Quad> quads;
  for (const Fiber& fiber : fibers) {
    const int n = fiber.config.nodes_per_section;
    const int last_section = fiber.config.sections - 1;
    for (int s = 0; s < last_section; ++s) {
      const int here = fiber.first_node + s * n;
      const int next = here + n;
      for (int a = 0; a < n; ++a) {
        const int b = (a + 1) % n;
        quads.push_back({here + a, here + b, next + b, next + a});
      }
    }
    add_cap(fiber.first_node, n, /*reversed=*/true, quads);
    add_cap(fiber.first_node + last_section * n, n, /*reversed=*/false, quads);
  }
  return quads;
}

std::size_t count_surface_quads(const std::vector<Fiber>& fibers) {
  std::size_t n_quads = 0;
  for (const Fiber& fiber : fibers) {
    const auto n = static_cast<std::size_t>(fiber.config.nodes_per_section);
    n_quads += (static_cast<std::size_t>(fiber.config.sections) - 1) * n + 2 * ((n - 1) / 2);
  }
  return n_quads;
}

}  // namespace skein
