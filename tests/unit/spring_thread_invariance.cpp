#include <skein/arrays/runtime.hpp>
#include <skein/physics/section_repulsion.hpp>
#include <skein/physics/spring_forces.hpp>

#include <cmath>
#include <cstdio>
#include <string_view>

// Prints a hash of the bits of forces and energies of springs and repulsion, for compare_thread_counts.cmake to compare
// between numbers of threads. The first line says how many threads there were.

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
    // The two fibers lie in each other.
    const SectionRepulsion repulsion(fibers, 1.7, 0.0123);
    std::vector<double> energy(fibers.size());
    repulsion.add_forces(position, force);
    print_hash("repelled", to_host(force));
    repulsion.add_force_changes(position, force, force);
    print_hash("changed", to_host(force));
    repulsion.add_energies(position, energy);
    print_hash("repulsion", energy);
    print_hash("moments", repulsion.compute_moments(position));
  }
}

}  // namespace
}  // namespace skein

int main() {
  const skein::Runtime runtime;
  skein::print_hashes();
}
