// What the repulsion between sections costs beside springs and fluid, in one run: one long fiber, bundles whose fibers
// repel each other all along, and suspensions in which few do. Usage: bench_repulsion [tiny] (threads: OMP_NUM_THREADS)

#include <skein/arrays/runtime.hpp>
#include <skein/fibers/placement.hpp>
#include <skein/physics/fmm_mobility.hpp>
#include <skein/physics/section_repulsion.hpp>
#include <skein/physics/spring_forces.hpp>

#include "harness.hpp"

#include <cmath>
#include <cstdio>
#include <functional>
#include <string>

namespace {

using namespace skein;

void measure(const char* name, const SceneConfig& scene) {
  const auto fibers = make_fibers(place_fibers(scene).fibers);
  const auto nodes = make_surface_nodes(fibers);
  const Vectors position = to_device("position", nodes);
  const Vectors force("force", nodes.size()), velocity("velocity", nodes.size());
  const Scalars blob = to_device("blob", make_blobs(fibers));
  const SpringForces springs(fibers);
  const SectionRepulsion repulsion(fibers, 2.3, fibers[0].config.radius);
  FmmOptions options;
  options.tolerance = 1e-4;
  options.check_every = 0;
  FmmMobility fluid(scene.fluid.viscosity, options);
  const auto seconds = perf::median_seconds(
      3, std::vector<std::function<void()>>{[&] { springs.add_forces(0.0, position, force); },
                                            [&] { repulsion.add_forces(0.0, position, force); },
                                            [&] { repulsion.add_force_changes(0.0, position, position, force); },
                                            [&] {
                                              fluid.add_velocity({position, force, blob}, position, velocity);
                                            }});
  std::printf(
      "%-11s %6zu fibers %7d sections: springs %9.3f ms, repulsion %9.3f, its change %9.3f, fluid %10.2f; "
      "repulsion / fluid %.5f\n",
      name, fibers.size(), count_sections(fibers), 1e3 * seconds[0], 1e3 * seconds[1], 1e3 * seconds[2],
      1e3 * seconds[3], seconds[1] / seconds[3]);
  std::fflush(stdout);
}

SceneConfig make_scene(const int n_fibers, const int sections) {
  SceneConfig scene;
  scene.fibers.resize(1);
  scene.fibers[0].sections = sections;
  scene.placement.count = n_fibers;
  return scene;
}

void measure_all(const bool tiny) {
  measure("one fiber", make_scene(1, tiny ? 20 : 1313));
  for (const int n_fibers : tiny ? std::vector{8} : std::vector{125, 1000}) {
    const int sections = tiny ? 6 : 80;
    const double side = std::cbrt(n_fibers);
    SceneConfig bundle = make_scene(n_fibers, sections);
    bundle.placement.kind = PlacementKind::grid;
    bundle.placement.grid = {1.0, std::round(std::sqrt(n_fibers)), std::round(std::sqrt(n_fibers))};
    bundle.placement.spacing = {1.0, 0.012, 0.012};  // centrelines 2.4 radii apart
    measure("bundle", bundle);
    SceneConfig suspension = make_scene(n_fibers, sections);
    suspension.placement.kind = PlacementKind::random;
    suspension.placement.orientation = Orientation::random;
    suspension.placement.box = {0.1 * side, 0.1 * side, 0.1 * side};  // n L^3 about 3
    measure("suspension", suspension);
  }
}

}  // namespace

int main(const int argc, const char** argv) {
  const Runtime runtime;
  skein::perf::print_context();
  measure_all(argc > 1 && std::string(argv[1]) == "tiny");
}
