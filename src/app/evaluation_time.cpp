#include "app/evaluation_time.hpp"

#include <algorithm>
#include <chrono>
#include <skein/time/make_integrator.hpp>
#include <vector>

#include "app/make_mobility.hpp"
#include "app/run_description.hpp"

namespace skein {
namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(const Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

}  // namespace

double time_evaluation(FiberDynamics& dynamics, const ConstVectors& position) {
  const Vectors velocity("skein::time_evaluation", position.extent(0));
  std::vector<double> seconds;
  for (int repeat = 0; repeat < 6; ++repeat) {
    const auto start = Clock::now();
    dynamics.compute_velocity(0.0, position, velocity);
    Kokkos::fence();
    const double last = seconds_since(start);
    const bool is_long = last > 1.0;  // a rough figure will do
    if (repeat > 0 || is_long) seconds.push_back(last);
    if (is_long) break;
  }
  std::nth_element(seconds.begin(), seconds.begin() + seconds.size() / 2, seconds.end());
  return seconds[seconds.size() / 2];
}

std::string describe_dry_run(const SceneConfig& scene) {
  const auto fibers = make_fibers(scene.fibers);
  FiberDynamics dynamics(fibers, std::make_unique<SpringForces>(fibers), make_background_flow(scene.flows),
                         make_mobility(scene));
  const auto integrator = make_integrator(scene, fibers, dynamics);
  const Vectors position = to_device("skein::describe_dry_run", make_surface_nodes(fibers, scene.seed));
  return describe_run(scene, fibers, dynamics, *integrator, time_evaluation(dynamics, position));
}

}  // namespace skein
