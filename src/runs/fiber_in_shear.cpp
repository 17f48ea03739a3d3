#include "runs/fiber_in_shear.hpp"

#include <skein/fibers/calibration.hpp>
#include <skein/fibers/fiber.hpp>

#include <algorithm>
#include <cmath>

namespace skein {
namespace {

bool is_steady_shear(const std::vector<FlowConfig>& flows) {
  if (flows.size() != 1) return false;
  const FlowConfig& flow = flows.front();
  return flow.kind == FlowKind::shear && flow.rate != 0.0 && flow.angular_frequency == 0.0 && flow.phase == 0.0 &&
         flow.start <= 0.0 && flow.stop == 0.0;
}

bool lies_along_x(const FiberConfig& fiber) {
  constexpr double least_cosine = 0.999;
  // A bend or noise of this size changes when a fiber turns by a per cent of its half period.
  constexpr double most_bent = 1e-3;
  return std::abs(fiber.direction.x) >= least_cosine * norm(fiber.direction) && !fiber.is_helix() &&
         fiber.start_amplitude <= most_bent && fiber.start_noise <= most_bent;
}

bool is_uniform(const FiberConfig& fiber) {
  const auto& profile = fiber.stiffness_profile;
  return std::all_of(profile.begin(), profile.end(),
                     [&](const ProfilePoint& point) { return point.factor == profile.front().factor; });
}

}  // namespace

bool is_single_fiber(const SceneConfig& scene) {
  return scene.fibers.size() == 1 && scene.gravity.weight == 0.0 && scene.tethers.empty() && scene.torques.empty() &&
         scene.undulations.empty() && scene.clamps.empty() && scene.start.checksum.empty();
}

std::optional<FiberInShear> find_fiber_in_shear(const SceneConfig& scene) {
  if (!is_single_fiber(scene) || !is_steady_shear(scene.flows)) return std::nullopt;
  const FiberConfig& config = scene.fibers.front();
  if (config.is_rigid() || !lies_along_x(config) || !is_uniform(config)) return std::nullopt;
  const Fiber fiber = make_fibers(scene.fibers).front();
  const double rate = std::abs(scene.flows.front().rate);
  return FiberInShear{
      fiber.length() / config.radius,
      measure_beam_stiffness(fiber).relaxed_bending / (scene.fluid.viscosity * rate * std::pow(config.radius, 4)),
      rate};
}

}  // namespace skein
