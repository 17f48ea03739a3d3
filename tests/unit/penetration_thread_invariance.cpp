// Prints the bits of what is found of fibers that stick in each other, for compare_thread_counts.cmake to compare
// between numbers of threads. The first line says how many threads there were.
#include <skein/arrays/runtime.hpp>
#include <skein/physics/sections.hpp>

#include "tests/reference/point_cloud.hpp"

#include <cstdio>

int main() {
  const skein::Runtime runtime;
  std::printf("threads %d\n", skein::HostSpace().concurrency());
  for (std::uint64_t seed = 0; seed < 10; ++seed) {
    skein::reference::Random random(seed);
    std::vector<skein::FiberConfig> configs(6);
    for (skein::FiberConfig& config : configs) {
      config.sections = 100;
      config.center = random.in_cube(0.01);
      config.direction = random.direction();
    }
    const auto fibers = skein::make_fibers(configs);
    const skein::Sections sections(fibers);
    const auto found = sections.compute_penetration(skein::to_device("position", skein::make_surface_nodes(fibers)));
    std::printf("%d %a\n", found.nodes, found.depth);
  }
}
