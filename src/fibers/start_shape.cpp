#include <skein/core/counter_random.hpp>
#include <skein/fibers/start_shape.hpp>

#include <cmath>
#include <numbers>

namespace skein {
namespace {

constexpr int n_noise_modes = 10;

/// A bend of the centreline: deflection (to_0, to_90) sin(mode pi s) L over the share s of the length L.
struct Bend {
  int mode;
  double to_0, to_90;  ///< along the axes of angle 0 and 90 degrees of the fiber without roll, over L
};

std::vector<Bend> list_bends(const Fiber& fiber, const std::uint64_t seed) {
  const FiberConfig& config = fiber.config;
  std::vector<Bend> bends;
  if (config.start_amplitude > 0.0) {
    const double plane = config.start_plane * std::numbers::pi / 180.0;
    bends.push_back(
        {config.start_mode, config.start_amplitude * std::cos(plane), config.start_amplitude * std::sin(plane)});
  }
  if (config.start_noise > 0.0) {
    const CounterRandom random(seed, CounterRandom::Purpose::start_noise, static_cast<std::uint32_t>(fiber.index));
    for (int mode = 1; mode <= n_noise_modes; ++mode) {
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
  const auto bends = list_bends(fiber, seed);
  return bends.empty() ? make_straight(fiber) : make_bent(fiber, bends);
}

double bound_start_deflection(const Fiber& fiber) {
  // Twice: the middle of the sections stays where it is, not the ends.
  return 2.0 * fiber.length() *
         (fiber.config.start_amplitude + std::numbers::sqrt2 * n_noise_modes * fiber.config.start_noise);
}

}  // namespace skein
