#include <skein/time/make_integrator.hpp>

#include <skein/core/error.hpp>
#include <skein/time/euler.hpp>
#include <skein/time/explicit_runge_kutta.hpp>
#include <skein/time/rkc2.hpp>
#include <skein/time/tr_bdf2.hpp>

#include <algorithm>
#include <cmath>

namespace skein {
namespace {

Rkc2Options make_options(const SceneConfig& scene, const double length, const double spacing) {
  Rkc2Options options;
  options.tolerance = scene.time.tolerance;
  options.length_scale = length;
  if (scene.flow.kind != "none" && scene.flow.rate != 0.0) options.time_scale = 1.0 / std::abs(scene.flow.rate);
  options.fixed_step = scene.time.step;
  options.max_step = scene.time.max_step;
  options.displacement = 1e-5 * spacing;
  options.seed = scene.seed;
  return options;
}

}  // namespace

std::unique_ptr<Integrator> make_integrator(const SceneConfig& scene, const std::vector<Fiber>& fibers,
                                            RightHandSide& rhs) {
  const int n_nodes = count_nodes(fibers);
  double length = 0.0, spacing = fibers.front().spacing();
  for (const Fiber& fiber : fibers) {
    length = std::max(length, fiber.length());
    spacing = std::min(spacing, fiber.spacing());
  }
  const std::string& method = scene.time.method;
  if (method == "euler") return std::make_unique<Euler>(rhs, scene.time.step, length, n_nodes);
  const Rkc2Options options = make_options(scene, length, spacing);
  if (method == "rk4")
    return std::make_unique<ExplicitRungeKutta>(rhs, options, make_classical_runge_kutta(), n_nodes);
  if (method == "bs3") return std::make_unique<ExplicitRungeKutta>(rhs, options, make_bogacki_shampine(), n_nodes);
  if (method == "trbdf2") return std::make_unique<TrBdf2>(rhs, options, n_nodes);
  SKEIN_REQUIRE(method == "rkc2", "unknown integrator '" + method + "'");
  return std::make_unique<Rkc2>(rhs, options, n_nodes);
}

}  // namespace skein
