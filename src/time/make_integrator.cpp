#include <skein/time/make_integrator.hpp>

#include <skein/core/error.hpp>
#include <skein/model/background_flow.hpp>
#include <skein/time/euler.hpp>
#include <skein/time/rkc2.hpp>

#include <algorithm>
#include <cmath>

namespace skein {

std::unique_ptr<Integrator> make_integrator(const SceneConfig& scene, const std::vector<Fiber>& fibers,
                                            RightHandSide& rhs) {
  const int n_nodes = count_nodes(fibers);
  double length = 0.0, spacing = fibers.front().spacing();
  for (const Fiber& fiber : fibers) {
    length = std::max(length, fiber.length());
    spacing = std::min(spacing, fiber.spacing());
  }
  if (scene.time.method == "euler") return std::make_unique<Euler>(rhs, scene.time.step, length, n_nodes);
  SKEIN_REQUIRE(scene.time.method == "rkc2", "unknown integrator '" + scene.time.method + "'");
  Rkc2Options options;
  options.tolerance = scene.time.tolerance;
  options.length_scale = length;
  const double flow_time = make_background_flow(scene.flows)->time_scale();
  if (std::isfinite(flow_time)) options.time_scale = flow_time;
  options.fixed_step = scene.time.step;
  options.max_step = scene.time.max_step;
  options.displacement = 1e-5 * spacing;
  options.seed = scene.seed;
  return std::make_unique<Rkc2>(rhs, options, n_nodes);
}

}  // namespace skein
