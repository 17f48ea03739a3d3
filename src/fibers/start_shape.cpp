#include <skein/core/counter_random.hpp>
#include <skein/core/error.hpp>
#include <skein/fibers/helix.hpp>
#include <skein/fibers/start_shape.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace skein {
namespace {

constexpr int n_noise_modes = 10;

/// A bend of the centreline: slope (to_0, to_90) mode pi cos(mode pi s) over the share s of the length.
struct Bend {
  int mode;
  double to_0, to_90;  ///< along the axes of angle 0 and 90 degrees of the fiber without roll; small: deflection / L
};

/// Largest distance of a section's centre from the line through the ends, over the length, of one bend alone.
double measure_bend(const int n_sections, const int mode, const double slope) {
  std::vector<Vec3> center(1);
  for (int s = 1; s < n_sections; ++s) {
    const double rise = slope * std::cos(mode * std::numbers::pi * s / n_sections);
    center.push_back(center.back() + Vec3{1.0, rise, 0.0} / (std::hypot(1.0, rise) * n_sections));
  }
  const Vec3 chord = center.back() / norm(center.back());
  double largest = 0.0;
  for (const Vec3 point : center) largest = std::max(largest, norm(cross(chord, point)));
  return largest;
}

/// The slope that makes a bend as large as the scene asks for: by regula falsi, with Illinois' change of weights.
double find_slope(const FiberConfig& config) {
  const auto excess = [&](const double slope) {
    return measure_bend(config.sections, config.start_mode, slope) - config.start_amplitude;
  };
  constexpr double steepest = 1e4;
  double low = 0.0, high = config.start_mode * std::numbers::pi * config.start_amplitude;
  double below = -config.start_amplitude, above = excess(high);
  while (above < 0.0) {
    if (high > steepest)
      throw Error(ExitCode::scene_error,
                  fmt::format("start_amplitude {:g} is more than a fiber can reach with {} half waves",
                              config.start_amplitude, config.start_mode));
    low = high;
    below = above;
    high *= 2.0;
    above = excess(high);
  }
  constexpr int n_steps = 100;
  for (int step = 0, side = 0; step < n_steps; ++step) {
    const double slope = (low * above - high * below) / (above - below), found = excess(slope);
    if (std::abs(found) <= 1e-14 * config.start_amplitude || high - low <= 1e-15 * high) return slope;
    if (found > 0.0) {
      high = slope;
      above = found;
      if (side == 1) below *= 0.5;
      side = 1;
    } else {
      low = slope;
      below = found;
      if (side == -1) above *= 0.5;
      side = -1;
    }
  }
  return high;
}

std::vector<Bend> list_bends(const Fiber& fiber, const std::uint64_t seed) {
  const FiberConfig& config = fiber.config;
  std::vector<Bend> bends;
  if (config.start_amplitude > 0.0) {
    const double plane = config.start_plane * std::numbers::pi / 180.0;
    const double height = find_slope(config) / (config.start_mode * std::numbers::pi);
    bends.push_back({config.start_mode, height * std::cos(plane), height * std::sin(plane)});
  }
  if (config.start_noise > 0.0) {
    const CounterRandom random(seed, CounterRandom::Purpose::start_noise, static_cast<std::uint32_t>(fiber.index));
    const int n_modes = std::clamp(config.sections / sections_per_half_wave, 1, n_noise_modes);
    for (int mode = 1; mode <= n_modes; ++mode) {
      const auto [a, b] = random.draw(static_cast<std::uint64_t>(mode));
      bends.push_back({mode, config.start_noise * (2.0 * a - 1.0), config.start_noise * (2.0 * b - 1.0)});
    }
  }
  return bends;
}

/// Direction of the centreline at the share s of the length, in the axes of the straight fiber. Length 1
Vec3 find_tangent(const std::vector<Bend>& bends, const double s) {
  Vec3 tangent{1.0, 0.0, 0.0};
  for (const Bend& bend : bends) {
    const double slope = bend.mode * std::numbers::pi * std::cos(bend.mode * std::numbers::pi * s);
    tangent = tangent + Vec3{0.0, slope * bend.to_0, slope * bend.to_90};
  }
  return tangent / norm(tangent);
}

Vec3 combine(const FiberAxes& axes, const Vec3 v) {
  return v.x * axes.along + v.y * axes.angle_0 + v.z * axes.angle_90;
}

std::vector<SectionPose> make_straight(const Fiber& fiber) {
  const FiberConfig& config = fiber.config;
  const FiberAxes axes = make_fiber_axes(config.direction, config.roll);
  std::vector<SectionPose> poses;
  for (int section = 0; section < config.sections; ++section) {
    const double arc = (section - 0.5 * (config.sections - 1)) * fiber.spacing();
    poses.push_back({config.center + arc * axes.along, axes});
  }
  return poses;
}

std::vector<SectionPose> make_bent(const Fiber& fiber, const std::vector<Bend>& bends) {
  const FiberConfig& config = fiber.config;
  const FiberAxes straight = make_fiber_axes(config.direction, 0.0);
  const int n = config.sections;
  std::vector<SectionPose> poses;
  Vec3 center, sum;
  for (int section = 0; section < n; ++section) {
    if (section > 0)
      center = center + fiber.spacing() * combine(straight, find_tangent(bends, static_cast<double>(section) / n));
    sum = sum + center;
    const FiberAxes local = make_fiber_axes(find_tangent(bends, (section + 0.5) / n), config.roll);
    poses.push_back(
        {center,
         {combine(straight, local.along), combine(straight, local.angle_0), combine(straight, local.angle_90)}});
  }
  const Vec3 shift = config.center - sum / static_cast<double>(n);
  for (SectionPose& pose : poses) pose.center = pose.center + shift;
  return poses;
}

}  // namespace

FiberAxes make_fiber_axes(const Vec3 direction, const double roll_degrees) {
  const Vec3 d = direction / norm(direction);
  const double sideways_squared = d.y * d.y + d.z * d.z;
  // 1 + cos(angle to x), written without cancellation near -x.
  const double one_plus_cosine = d.x >= 0.0 ? 1.0 + d.x : sideways_squared / (1.0 - d.x);

  Vec3 y{0.0, -1.0, 0.0};
  Vec3 z{0.0, 0.0, 1.0};
  if (one_plus_cosine > 0.0) {
    const double skew = d.y * d.z / one_plus_cosine;
    y = {-d.y, 1.0 - d.y * d.y / one_plus_cosine, -skew};
    z = {-d.z, -skew, 1.0 - d.z * d.z / one_plus_cosine};
  }
  const double roll = roll_degrees * std::numbers::pi / 180.0;
  const double cosine = std::cos(roll);
  const double sine = std::sin(roll);
  return {d, cosine * y + sine * z, cosine * z - sine * y};
}

std::vector<SectionPose> make_section_poses(const Fiber& fiber, const std::uint64_t seed) {
  if (fiber.config.is_helix()) return make_helix(fiber);
  const auto bends = list_bends(fiber, seed);
  return bends.empty() ? make_straight(fiber) : make_bent(fiber, bends);
}

double bound_start_deflection(const Fiber& fiber) {
  // Twice: the middle of the sections stays where it is, not the ends.
  return fiber.config.helix_radius +
         2.0 * fiber.length() *
             (fiber.config.start_amplitude + std::numbers::sqrt2 * n_noise_modes * fiber.config.start_noise);
}

}  // namespace skein
