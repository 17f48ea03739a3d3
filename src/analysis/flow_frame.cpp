#include <skein/analysis/flow_frame.hpp>
#include <skein/analysis/orientation.hpp>

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace skein {
namespace {

constexpr double pi = std::numbers::pi;
constexpr double negligible = 1e-9;  ///< share of a gradient, or of a vector, that is taken for rounding

double measure_size(const Matrix3& gradient) {
  double sum = 0.0;
  for (const auto& row : gradient)
    for (const double entry : row) sum += entry * entry;
  return std::sqrt(sum);
}

Vec3 compute_vorticity(const Matrix3& g) { return {g[2][1] - g[1][2], g[0][2] - g[2][0], g[1][0] - g[0][1]}; }

/// a . E b, E the symmetric part.
double strain_between(const Matrix3& g, const Vec3 a, const Vec3 b) {
  const double left[3] = {a.x, a.y, a.z}, right[3] = {b.x, b.y, b.z};
  double sum = 0.0;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) sum += 0.5 * (g[i][j] + g[j][i]) * left[i] * right[j];
  return sum;
}

/// A unit vector at right angles to one of length 1: the axis of space least along it, as far as it can be.
Vec3 find_first_axis(const Vec3 normal) {
  const double size[3] = {std::abs(normal.x), std::abs(normal.y), std::abs(normal.z)};
  Vec3 axis{1.0, 0.0, 0.0};
  if (size[1] < size[0] && size[1] <= size[2]) axis = {0.0, 1.0, 0.0};
  if (size[2] < size[0] && size[2] < size[1]) axis = {0.0, 0.0, 1.0};
  const Vec3 inside = axis - dot(axis, normal) * normal;
  return inside / norm(inside);
}

FlowFrame make_turning_frame(const Matrix3& gradient, const Vec3 vorticity, const double size) {
  FlowFrame frame;
  frame.normal = -vorticity / norm(vorticity);
  const Vec3 p = find_first_axis(frame.normal), q = cross(frame.normal, p);
  const double stretch = 0.5 * (strain_between(gradient, p, p) - strain_between(gradient, q, q));
  const double shear = strain_between(gradient, p, q);
  frame.angle_origin = AngleOrigin::first_direction;
  if (std::hypot(stretch, shear) <= negligible * size) return frame;
  frame.angle_origin = AngleOrigin::flow;
  const double extension = 0.5 * std::atan2(shear, stretch);  // counter-clockwise from p
  const double turn = extension - 0.25 * pi;
  frame.along = std::cos(turn) * p + std::sin(turn) * q;
  frame.gradient = cross(frame.normal, frame.along);
  return frame;
}

FlowFrame make_straining_frame(const Matrix3& gradient) {
  Eigen::Matrix3d strain;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) strain(i, j) = 0.5 * (gradient[i][j] + gradient[j][i]);
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> axes(strain);
  const auto& rate = axes.eigenvalues();  // growing
  const auto axis = [&](const int i) {
    const Eigen::Vector3d v = axes.eigenvectors().col(i);
    return Vec3{v[0], v[1], v[2]};
  };
  const double largest = std::max(std::abs(rate[0]), std::abs(rate[2]));
  FlowFrame frame;
  frame.angle_origin = AngleOrigin::strain_axis;
  // Of a planar extension's two axes the compressing one, along which fibers buckle.
  frame.along = std::abs(rate[0]) >= (1.0 - negligible) * largest ? axis(0) : axis(2);
  if (std::abs(rate[1]) <= negligible * largest) {
    frame.normal = axis(1);
    frame.gradient = cross(frame.normal, frame.along);
  }
  return frame;
}

double angle_between(const Vec3 a, const Vec3 b) { return std::atan2(norm(cross(a, b)), dot(a, b)); }

/// Calls visit(i, end) for each moment at which the fiber has a direction in the plane across `normal`, or in space
/// where that is zero; the end is the part of the end-to-end vector in it.
template <class Visit>
void visit_directions(const std::span<const Vec3> end_to_end, const Vec3 normal, const Visit& visit) {
  double longest = 0.0;
  for (const Vec3 end : end_to_end) longest = std::max(longest, norm(end));
  for (std::size_t i = 0; i < end_to_end.size(); ++i) {
    const Vec3 inside = end_to_end[i] - dot(end_to_end[i], normal) * normal;
    if (norm(inside) > negligible * longest) visit(i, inside);
  }
}

}  // namespace

const char* name_of(const AngleOrigin origin) {
  switch (origin) {
    case AngleOrigin::flow:
      return "direction of the flow";
    case AngleOrigin::first_direction:
      return "first direction in the plane of rotation";
    case AngleOrigin::strain_axis:
      return "axis of strain";
    case AngleOrigin::own_direction:
      break;
  }
  return "first direction";
}

FlowFrame make_flow_frame(const Matrix3& gradient) {
  const double size = measure_size(gradient);
  if (!(size > 0.0)) return {};
  const Vec3 vorticity = compute_vorticity(gradient);
  if (norm(vorticity) > negligible * size) return make_turning_frame(gradient, vorticity, size);
  return make_straining_frame(gradient);
}

std::vector<double> measure_angles(const FlowFrame& frame, const std::span<const Vec3> end_to_end) {
  std::vector<double> angle(end_to_end.size(), 0.0);
  std::vector<bool> is_known(end_to_end.size(), false);
  const Vec3 plane = frame.turns_fibers() ? frame.normal : Vec3{};
  FlowFrame from = frame;
  bool is_first = true;
  visit_directions(end_to_end, plane, [&](const std::size_t i, const Vec3 end) {
    if (is_first && norm(from.along) == 0.0) {
      from.along = end / norm(end);
      from.gradient = cross(from.normal, from.along);
    }
    is_first = false;
    is_known[i] = true;
    switch (frame.angle_origin) {
      case AngleOrigin::flow:
      case AngleOrigin::first_direction:
        angle[i] = compute_clockwise_angle(end, from);
        break;
      case AngleOrigin::strain_axis:
        angle[i] = std::min(angle_between(end, from.along), angle_between(end, -from.along));
        break;
      case AngleOrigin::own_direction:
        angle[i] = angle_between(end, from.along);
        break;
    }
  });
  const auto first = static_cast<std::size_t>(std::find(is_known.begin(), is_known.end(), true) - is_known.begin());
  for (std::size_t i = first + 1; i < angle.size(); ++i)
    if (!is_known[i]) angle[i] = angle[i - 1];
  if (!frame.turns_fibers() || first == angle.size()) return angle;
  for (std::size_t i = 0; i < first; ++i) angle[i] = angle[first];
  angle = unwrap_angles(angle);
  // Into (-pi/2, pi/2], with rounding's room at the lower end.
  const double half_turns = std::ceil(angle.front() / pi - 0.5 - negligible);
  for (double& a : angle) a -= pi * half_turns;
  return angle;
}

}  // namespace skein
