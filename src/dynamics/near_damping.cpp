#include "dynamics/near_damping.hpp"

#include <skein/arrays/types.hpp>
#include <skein/core/error.hpp>

#include "kernels/regularized_stokeslet.hpp"

#include <Eigen/Dense>

#include <algorithm>
#include <cstdlib>

namespace skein {
namespace {

using Block = Eigen::MatrixXd;

/// factor (outer d d^T + isotropic I), added to the 3 x 3 block of nodes a and b.
void add_pair(Block& block, const int a, const int b, const Vec3 d, const double outer, const double isotropic) {
  const double v[3] = {d.x, d.y, d.z};
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) block(3 * a + i, 3 * b + j) += outer * v[i] * v[j];
    block(3 * a + i, 3 * b + i) += isotropic;
  }
}

/// -dF/dx of the springs between section s and section s + offset: adds to both ends' own blocks, and returns the block
/// that couples them.
Block add_springs(const NearFiber& fiber, const std::vector<Vec3>& position, const int s, const int offset, Block& own,
                  Block& others) {
  const int n = fiber.nodes_per_section;
  const double* factors = fiber.section_factor;
  const double factor = factors == nullptr ? 1.0 : 0.5 * (factors[s] + factors[s + offset]);
  Block coupling = Block::Zero(3 * n, 3 * n);
  for (int a = 0; a < n; ++a)
    for (int b = offset == 0 ? a + 1 : 0; b < n; ++b) {
      const int entry = offset * n + (b >= a ? b - a : b - a + n);
      const double stiffness = factor * fiber.stiffness[entry];
      const Vec3 d = position[s * n + a] - position[(s + offset) * n + b];
      const double r_squared = dot(d, d);
      if (stiffness == 0.0 || r_squared == 0.0) continue;
      const double inverse_r = 1.0 / std::sqrt(r_squared);
      const double outer = stiffness * inverse_r * inverse_r * inverse_r;
      // Springs under compression would make the matrix indefinite: left out, as it is only a preconditioner.
      const double isotropic = std::max(0.0, stiffness * (fiber.inverse_rest_length[entry] - inverse_r));
      add_pair(own, a, a, d, outer, isotropic);
      add_pair(others, b, b, d, outer, isotropic);
      if (offset == 0) {
        add_pair(own, a, b, d, -outer, -isotropic);
        add_pair(own, b, a, d, -outer, -isotropic);
      } else {
        add_pair(coupling, a, b, d, -outer, -isotropic);
      }
    }
  return coupling;
}

Block make_mobility(const NearFiber& fiber, const std::vector<Vec3>& position, const int s, const int t,
                    const double factor) {
  const int n = fiber.nodes_per_section;
  Block block = Block::Zero(3 * n, 3 * n);
  const double scale = factor * regularized_stokeslet::scale(fiber.viscosity);
  for (int a = 0; a < n; ++a)
    for (int b = 0; b < n; ++b) {
      const Vec3 d = position[s * n + a] - position[t * n + b];
      const auto weight = regularized_stokeslet::weights(d.x, d.y, d.z, fiber.blob * fiber.blob);
      add_pair(block, a, b, d, scale * weight.along, scale * weight.isotropic);
    }
  return block;
}

}  // namespace

void compute_near_damping(const NearFiber& fiber, const std::vector<Vec3>& position, const int width,
                          const double scale, BlockBand& band) {
  const int n = fiber.nodes_per_section, n_sections = fiber.n_sections, reach = fiber.reach;
  SKEIN_REQUIRE(static_cast<int>(position.size()) == n_sections * n, "positions are those of the fiber's nodes");
  SKEIN_REQUIRE(band.half_width() == std::min(near_half_width(fiber, width), n_sections - 1), "the band has the width");

  std::vector<Block> own(n_sections, Block::Zero(3 * n, 3 * n));
  std::vector<Block> coupling(static_cast<std::size_t>(n_sections) * (reach + 1));
  for (int s = 0; s < n_sections; ++s)
    for (int offset = 0; offset <= reach && s + offset < n_sections; ++offset)
      coupling[s * (reach + 1) + offset] = add_springs(fiber, position, s, offset, own[s], own[s + offset]);

  band.set_to_zero();
  Kokkos::parallel_for(
      "skein::compute_near_damping", Kokkos::RangePolicy<HostSpace>(HostSpace(), 0, n_sections), [&](const int s) {
        const auto target = [&](const int t) { return Eigen::Map<Block>(band.block(s, t), 3 * n, 3 * n); };
        for (int u = std::max(0, s - width); u <= std::min(n_sections - 1, s + width); ++u) {
          const double taper = 1.0 - std::abs(s - u) / (width + 1.0);
          const Block mobility = make_mobility(fiber, position, s, u, scale * taper);
          target(u).noalias() += mobility * own[u];
          for (int offset = 1; offset <= reach; ++offset) {
            if (u + offset < n_sections) target(u + offset).noalias() += mobility * coupling[u * (reach + 1) + offset];
            if (u - offset >= 0)
              target(u - offset).noalias() += mobility * coupling[(u - offset) * (reach + 1) + offset].transpose();
          }
        }
        target(s).diagonal().array() += 1.0;
      });
  HostSpace().fence();
}

}  // namespace skein
