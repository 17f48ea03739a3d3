#include <skein/fibers/helix.hpp>

#include <cmath>
#include <numbers>

namespace skein {
namespace {

/// Slope of the centreline against its axis, by the length along the axis from the shaft's end on.
class HelixSlope {
 public:
  explicit HelixSlope(const FiberConfig& config)
      : radius_(config.helix_radius),
        wave_number_(2.0 * std::numbers::pi / config.helix_pitch),
        taper_(config.helix_taper) {}

  /// (1, dy/dx, dz/dx) in the axes of the straight fiber.
  Vec3 at(const double x) const {
    if (x < 0.0) return {1.0, 0.0, 0.0};
    const double fall = taper_ > 0.0 ? std::exp(-(x / taper_) * (x / taper_)) : 0.0;
    const double r = radius_ * (1.0 - fall), rise = taper_ > 0.0 ? 2.0 * radius_ * x * fall / (taper_ * taper_) : 0.0;
    const double c = std::cos(wave_number_ * x), s = std::sin(wave_number_ * x);
    return {1.0, rise * c - wave_number_ * r * s, rise * s + wave_number_ * r * c};
  }

  /// The place on the axis further along the centreline by a small arclength, by the midpoint rule.
  double advance(const double x, const double arclength) const {
    const double half = x + 0.5 * arclength / norm(at(x));
    return x + arclength / norm(at(half));
  }

 private:
  double radius_, wave_number_, taper_;
};

/// The axes turned with the direction along them by the smallest rotation that there is.
FiberAxes carry(const FiberAxes& axes, const Vec3 along) {
  const Vec3 both = axes.along + along;
  const double scale = 1.0 / (1.0 + dot(axes.along, along));
  const auto turn = [&](const Vec3 v) { return v - (scale * dot(v, along)) * both; };
  return {along, turn(axes.angle_0), turn(axes.angle_90)};
}

}  // namespace

std::vector<SectionPose> make_helix(const Fiber& fiber) {
  const FiberConfig& config = fiber.config;
  const HelixSlope slope(config);
  const FiberAxes straight = make_fiber_axes(config.direction, config.roll);
  const double spacing = fiber.spacing();
  const auto direction_at = [&](const double x) {
    const Vec3 local = slope.at(x);
    const Vec3 along = local.x * straight.along + local.y * straight.angle_0 + local.z * straight.angle_90;
    return along / norm(along);
  };
  constexpr int n_parts = 8;  // of a spacing, half of them before its middle
  Vec3 center = config.center - (0.5 * (config.sections - 1) * spacing) * straight.along;
  double place = -config.helix_shaft;
  std::vector<SectionPose> poses{{center, carry(straight, direction_at(place))}};
  for (int section = 1; section < config.sections; ++section) {
    for (int part = 0; part < n_parts / 2; ++part) place = slope.advance(place, spacing / n_parts);
    center = center + spacing * direction_at(place);
    for (int part = 0; part < n_parts / 2; ++part) place = slope.advance(place, spacing / n_parts);
    poses.push_back({center, carry(poses.back().axes, direction_at(place))});
  }
  return poses;
}

RestBend measure_rest_bend(const SectionPose& first, const SectionPose& second, const double length) {
  // Of a bend by an angle the frames halfway see the directions at both ends turned by half of it, and the distance of
  // nodes along the chord changes by twice the sine of that.
  const Vec3 change = second.axes.along - first.axes.along;
  return {dot(change, 0.5 * (first.axes.angle_0 + second.axes.angle_0)) / length,
          dot(change, 0.5 * (first.axes.angle_90 + second.axes.angle_90)) / length};
}

}  // namespace skein
