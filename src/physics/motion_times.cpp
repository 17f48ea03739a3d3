#include "motion_times.hpp"

#include <skein/fibers/calibration.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace skein {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

/// Force per length on a rod that moves across itself, over its velocity: 4 pi viscosity / ln(L/R), to leading order.
double transverse_drag(const Fiber& fiber, const double viscosity) {
  return 4.0 * std::numbers::pi * viscosity / std::max(1.0, std::log(fiber.length() / fiber.config.radius));
}

}  // namespace

double find_falling_time(const double weight, const std::vector<Fiber>& fibers, const double viscosity) {
  double time = infinity;
  if (weight == 0.0) return time;
  for (const Fiber& fiber : fibers) time = std::min(time, transverse_drag(fiber, viscosity) * fiber.length() / weight);
  return time;
}

double find_tether_time(const std::vector<TetherConfig>& tethers, const std::vector<Fiber>& fibers) {
  double time = infinity;
  for (const TetherConfig& tether : tethers) {
    const double speed = norm(tether.velocity) + std::abs(tether.angular_frequency) * norm(tether.swing);
    if (speed > 0.0) time = std::min(time, fibers[tether.fiber].length() / speed);
  }
  return time;
}

double find_torque_time(const std::vector<TorqueConfig>& torques, const std::vector<Fiber>& fibers,
                        const double viscosity) {
  double time = infinity;
  for (const TorqueConfig& torque : torques) {
    const Fiber& fiber = fibers[torque.fiber];
    const double length = fiber.length();
    const double drag = transverse_drag(fiber, viscosity) * (length * length * length) / 12.0;  // of its rotation
    if (norm(torque.torque) > 0.0) time = std::min(time, drag / norm(torque.torque));
  }
  return time;
}

double find_clamp_time(const std::vector<ClampConfig>& clamps, const std::vector<Fiber>& fibers) {
  double time = infinity;
  for (const ClampConfig& clamp : clamps) {
    const double frequency = std::abs(clamp.angular_frequency), speed = frequency * norm(clamp.swing);
    if (speed > 0.0) time = std::min(time, fibers[clamp.fiber].length() / speed);
    const double turn = std::max(norm(clamp.tilt) > 0.0 ? frequency : 0.0, std::abs(clamp.spin));
    if (turn > 0.0) time = std::min(time, 2.0 * std::numbers::pi / turn);
  }
  return time;
}

double find_undulation_time(const std::vector<UndulationConfig>& undulations) {
  double time = infinity;
  for (const UndulationConfig& wave : undulations)
    if (wave.curvature != 0.0 && wave.angular_frequency != 0.0)
      time = std::min(time, 2.0 * std::numbers::pi / std::abs(wave.angular_frequency));
  return time;
}

void add_endless_oscillation(TimeCourse& course, const double angular_frequency) {
  if (angular_frequency != 0.0)
    course.add_oscillation(0.0, infinity, 2.0 * std::numbers::pi / std::abs(angular_frequency));
}

double find_relaxation_time(const std::vector<Fiber>& fibers, const double viscosity) {
  constexpr double wave_number = 4.7300;  // times the length, of the first bend of a beam with free ends
  double time = infinity;
  for (const Fiber& fiber : fibers) {
    const double drag = transverse_drag(fiber, viscosity), squared = std::pow(fiber.length() / wave_number, 2);
    const BeamStiffness beam = measure_beam_stiffness(fiber);
    // A chain may have no rigidity against bends, and a rigid line an infinite one: then it is a stretch that relaxes.
    const bool bends = beam.bending > 0.0 && std::isfinite(beam.bending);
    time = std::min(time, bends ? drag * (squared * squared) / beam.bending : drag * squared / beam.axial);
  }
  return time;
}

}  // namespace skein
