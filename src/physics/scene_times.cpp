#include <skein/core/error.hpp>
#include <skein/fibers/fiber.hpp>
#include <skein/physics/flow_summary.hpp>
#include <skein/physics/scene_times.hpp>

#include "motion_times.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

namespace skein {
namespace {

constexpr double least_error = 1e-13;  // in a time scale, over the length: less is lost in the rounding of positions
constexpr double n_steps_allowed = 1e12;
constexpr double n_frames_allowed = 1e7;

/// @param scene  whose times are numbers
std::vector<KeyProblem> find_problems(const SceneConfig& scene, const double time_scale) {
  const TimeConfig& time = scene.time;
  std::vector<KeyProblem> problems;
  const auto reject = [&](const std::string& key, const std::string& what) {
    problems.push_back({key, fmt::format("{} {} (the scene's time scale is {:.3g})", key, what, time_scale)});
  };
  const double duration = time.end - time.start;
  const double reach = duration > 0.0 ? std::min(duration, time_scale) : time_scale;
  if (time.method != TimeMethod::euler && time.tolerance * reach > 1.0)
    reject("time.tolerance", fmt::format("{:g} allows an error of {:.3g} fiber lengths within a time of {:.3g}: take a "
                                         "smaller one, or leave the key out",
                                         time.tolerance, time.tolerance * reach, reach));
  if (time.method != TimeMethod::euler && time.tolerance * time_scale < least_error)
    reject("time.tolerance",
           fmt::format("{:g} is below the rounding of positions, {:.3g} per unit of time: take a larger "
                       "one, or leave the key out",
                       time.tolerance, least_error / time_scale));
  if (duration / (time.step > 0.0 ? time.step : time.max_step) > n_steps_allowed)
    reject("time.end", fmt::format("{:g} would take more than {:.0e} steps of {:.3g}", time.end, n_steps_allowed,
                                   time.step > 0.0 ? time.step : time.max_step));
  if (duration / scene.output.frame_interval > n_frames_allowed)
    reject("time.end", fmt::format("{:g} would make more than {:.0e} frames: set output.frame_interval", time.end,
                                   n_frames_allowed));
  return problems;
}

double round_to_three_digits(const double value) {
  const double unit = std::pow(10.0, 2.0 - std::floor(std::log10(value)));
  return std::round(value * unit) / unit;
}

/// @param time  resolved
double choose_sum_tolerance(const TimeConfig& time, const double time_scale) {
  constexpr double share = 2.5, least = 1e-6, largest = 1e-3, with_fixed_steps = 1e-5;
  if (time.step > 0.0) return with_fixed_steps;
  const double balanced = share * time.tolerance * time_scale;
  return balanced > least ? round_to_three_digits(std::min(balanced, largest)) : least;
}

/// The scene with numbers for all its times.
SceneConfig fill_in_times(SceneConfig scene, const double time_scale) {
  scene.time = resolve_time(scene.time, time_scale);
  double& sum_tolerance = scene.hydrodynamics.tolerance;
  if (sum_tolerance == 0.0) sum_tolerance = choose_sum_tolerance(scene.time, time_scale);
  if (scene.output.frame_interval == 0.0) scene.output.frame_interval = 0.125 * time_scale;
  return scene;
}

}  // namespace

double find_time_scale(const SceneConfig& scene) {
  const auto fibers = make_fibers(scene.fibers);
  const double viscosity = scene.fluid.viscosity;
  const double scale =
      std::min({summarize_flow(scene.flows).time_scale, find_tether_time(scene.tethers, fibers),
                find_torque_time(scene.torques, fibers, viscosity), find_undulation_time(scene.undulations),
                find_clamp_time(scene.clamps, fibers), find_falling_time(scene.gravity.weight, fibers, viscosity)});
  return std::isfinite(scale) ? scale : find_relaxation_time(fibers, viscosity);
}

// In shear of rate 2.5 these are 1e-4 and 0.1, to the last bit.
TimeConfig resolve_time(TimeConfig time, const double time_scale) {
  if (time.tolerance == 0.0) time.tolerance = 1e-4 / (2.5 * time_scale);
  if (time.max_step == 0.0) time.max_step = std::max(0.25 * time_scale, time.step);
  return time;
}

double find_sum_tolerance(const SceneConfig& scene) {
  if (scene.hydrodynamics.tolerance > 0.0) return scene.hydrodynamics.tolerance;
  const double time_scale = find_time_scale(scene);
  return choose_sum_tolerance(resolve_time(scene.time, time_scale), time_scale);
}

std::vector<KeyProblem> find_time_problems(const SceneConfig& scene) {
  const double time_scale = find_time_scale(scene);
  return find_problems(fill_in_times(scene, time_scale), time_scale);
}

SceneConfig resolve_times(SceneConfig scene) {
  const double time_scale = find_time_scale(scene);
  scene = fill_in_times(std::move(scene), time_scale);
  const auto problems = find_problems(scene, time_scale);
  if (!problems.empty()) throw Error(ExitCode::scene_error, problems.front().message);
  return scene;
}

}  // namespace skein
