#include <skein/analysis/plane_fit.hpp>
#include <skein/analysis/plane_tracker.hpp>
#include <skein/analysis/shape.hpp>
#include <skein/analysis/signed_curvature.hpp>

#include <algorithm>
#include <cmath>

namespace skein {
namespace {

constexpr double least_lean = 0.1;     ///< cosine from which a normal is on a side of another
constexpr double weak_turning = 1e-8;  ///< of a bend that is more than rounding, radians

/// Turning of the first bend that is at least half as strong as the strongest; 0 where none turns by `least`.
double find_first_turning(const std::span<const Vec3> centreline, const int reach, const Vec3 normal,
                          const double least) {
  const auto bends =
      find_bends(compute_arclength(centreline), compute_signed_curvature(centreline, reach, normal), least);
  double strongest = 0.0;
  for (const Bend& bend : bends) strongest = std::max(strongest, std::abs(bend.turning));
  for (const Bend& bend : bends)
    if (std::abs(bend.turning) >= 0.5 * strongest) return bend.turning;
  return 0.0;
}

}  // namespace

PlaneTracker::Plane PlaneTracker::follow(const std::span<const Vec3> centreline, const int reach) {
  Plane plane{fit_plane(centreline, flow_.has_plane() ? flow_.normal : before_).normal};
  if (dot(plane.normal, before_) < 0.0) plane.normal = -plane.normal;
  const double lean = flow_.turns_fibers() ? dot(plane.normal, flow_.normal) : 0.0;
  double side = 0.0;
  Evidence evidence = sign_;
  if (std::abs(lean) > least_lean) {
    side = lean;
    evidence = Evidence::certain;
  } else if (sign_ != Evidence::certain) {
    side = find_first_turning(centreline, reach, plane.normal, least_bend_turning);
    if (side != 0.0) {
      evidence = Evidence::certain;
    } else if (sign_ == Evidence::none) {
      side = find_first_turning(centreline, reach, plane.normal, weak_turning);
      if (side != 0.0) evidence = Evidence::weak_bend;
    }
  }
  if (side < 0.0) {
    plane.normal = -plane.normal;
    plane.turns_over = sign_ != Evidence::certain;
  }
  sign_ = evidence;
  before_ = plane.normal;
  return plane;
}

}  // namespace skein
