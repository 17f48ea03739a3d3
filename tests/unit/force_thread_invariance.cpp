// Prints a hash of the bits of forces, their changes, energies and moments of every kind of force, for
// compare_thread_counts.cmake to compare between numbers of threads. The first line says how many threads there were.
#include <skein/arrays/runtime.hpp>
#include <skein/physics/physics.hpp>

#include "tests/support/force_rows.hpp"

#include <cmath>
#include <cstdio>
#include <string_view>

namespace skein {
namespace {

template <class Value>
void print_hash(const char* force, const char* what, const std::vector<Value>& values) {
  const std::string_view bytes(reinterpret_cast<const char*>(values.data()), values.size() * sizeof(Value));
  std::printf("%s %s %zx\n", force, what, std::hash<std::string_view>()(bytes));
}

void print_hashes(const test::ForceRow& row, const std::vector<FiberConfig>& configs) {
  SceneConfig scene;
  scene.fibers = configs;  // the fibers lie in each other
  row.configure(scene);
  const Physics physics = make_physics(scene);
  auto nodes = make_surface_nodes(physics.fibers);
  for (std::size_t i = 0; i < nodes.size(); ++i) nodes[i].y += 1e-3 * std::sin(12.9898 * static_cast<double>(i));
  constexpr double time = 0.2;
  const Vectors position = to_device("position", nodes);
  const Vectors force("force", nodes.size()), change("change", nodes.size());
  std::vector<SymmetricTensor> moments(physics.fibers.size());
  const Force& last = *physics.forces.back();
  last.add_forces(time, position, force);
  print_hash(row.name, "forces", to_host(ConstVectors(force)));
  last.add_force_changes(time, position, force, change);
  print_hash(row.name, "changes", to_host(ConstVectors(change)));
  std::vector<double> energy(physics.fibers.size());
  last.add_energies(time, position, energy);
  print_hash(row.name, "energies", energy);
  last.add_moments(physics.fibers, time, position, moments);
  print_hash(row.name, "moments", moments);
}

void print_all() {
  std::printf("threads %d\n", HostSpace().concurrency());
  FiberConfig long_fiber, wide_fiber;
  long_fiber.sections = 113;
  wide_fiber.sections = 9;
  wide_fiber.nodes_per_section = 70;
  for (const auto& configs : {std::vector{long_fiber, long_fiber}, std::vector{long_fiber, wide_fiber}})
    for (const test::ForceRow& row : test::force_rows) print_hashes(row, configs);
}

}  // namespace
}  // namespace skein

int main() {
  const skein::Runtime runtime;
  skein::print_all();
}
