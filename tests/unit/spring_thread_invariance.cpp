#include <cmath>
#include <cstdio>
#include <skein/core/runtime.hpp>
#include <skein/model/spring_forces.hpp>
#include <string_view>

// Prints a hash of the bits of spring forces and energies, for compare_thread_counts.cmake to compare between numbers
// of threads. The first line says how many threads there were.

namespace skein {
namespace {

template <class Value>
void print_hash(const char* name, const std::vector<Value>& values) {
  const std::string_view bytes(reinterpret_cast<const char*>(values.data()), values.size() * sizeof(Value));
  std::printf("%s %zx\n", name, std::hash<std::string_view>()(bytes));
}

void print_hashes() {
  std::printf("threads %d\n", HostSpace().concurrency());
  FiberConfig long_fiber, wide_fiber;
  long_fiber.sections = 113;
  wide_fiber.sections = 9;
  wide_fiber.nodes_per_section = 70;
  for (const auto& configs : {std::vector{long_fiber, long_fiber}, std::vector{long_fiber, wide_fiber}}) {
    const auto fibers = make_fibers(configs);
    auto nodes = make_surface_nodes(fibers);
    for (std::size_t i = 0; i < nodes.size(); ++i) nodes[i].y += 1e-3 * std::sin(12.9898 * static_cast<double>(i));
    const Vectors position = to_device("position", nodes);
    const Vectors force("force", nodes.size());
    const SpringForces springs(fibers);
    springs.compute_forces(position, force);
    print_hash("forces", to_host(force));
    print_hash("energies", springs.compute_energies(position));
  }
}

}  // namespace
}  // namespace skein

int main() {
  const skein::Runtime runtime;
  skein::print_hashes();
}
