// What angles and signs refer to in flows of every kind, and that no axis of space is among it.
#include <skein/analysis/fiber_history.hpp>
#include <skein/analysis/plane_fit.hpp>

#include "known_curves.hpp"
#include "known_flows.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace skein {
namespace {

constexpr double pi = std::numbers::pi;

void expect_near(const Vec3 a, const Vec3 b) { EXPECT_LT(norm(a - b), 1e-14) << a.x << ' ' << a.y << ' ' << a.z; }

/// u = rate (across . x) along, a simple shear.
Matrix3 make_shear(const double rate, const Vec3 along, const Vec3 across) {
  const double a[3] = {along.x, along.y, along.z}, b[3] = {across.x, across.y, across.z};
  Matrix3 gradient{};
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) gradient[i][j] = rate * a[i] * b[j];
  return gradient;
}

TEST(FlowFrame, OfThePapersShearIsThatOfSpaceToTheLastBit) {
  const FlowFrame frame = make_flow_frame(shear_gradient);
  EXPECT_EQ(frame.angle_origin, AngleOrigin::flow);
  EXPECT_EQ(frame.along, (Vec3{1, 0, 0}));
  EXPECT_EQ(frame.gradient, (Vec3{0, 1, 0}));
  EXPECT_EQ(frame.normal, (Vec3{0, 0, 1}));
}

TEST(FlowFrame, OfAnyShearHasItsDirections) {
  const Vec3 along = Vec3{1, 2, 2} / 3.0, across = Vec3{2, 1, -2} / 3.0;
  const FlowFrame frame = make_flow_frame(make_shear(0.7, along, across));
  const double sense = dot(frame.along, along) > 0.0 ? 1.0 : -1.0;  // either way
  expect_near(sense * frame.along, along);
  expect_near(sense * frame.gradient, across);
  expect_near(frame.normal, cross(along, across));
  // A shear of negative rate is one of positive rate, upside down.
  expect_near(make_flow_frame(make_shear(-0.7, along, across)).normal, -frame.normal);
}

TEST(FlowFrame, OfFlowsWithoutVorticityIsTheirAxis) {
  const FlowFrame planar = make_flow_frame(compression_gradient);
  EXPECT_EQ(planar.angle_origin, AngleOrigin::strain_axis);
  EXPECT_NEAR(std::abs(planar.along.x), 1.0, 1e-14);
  EXPECT_NEAR(std::abs(planar.normal.z), 1.0, 1e-14);
  const FlowFrame uniaxial = make_flow_frame(uniaxial_gradient);
  EXPECT_NEAR(std::abs(uniaxial.along.x), 1.0, 1e-14);
  EXPECT_FALSE(uniaxial.has_plane());
  const FlowFrame rest = make_flow_frame({});
  EXPECT_EQ(rest.angle_origin, AngleOrigin::own_direction);
  EXPECT_FALSE(rest.turns_fibers());
  const FlowFrame rotation = make_flow_frame(rotation_gradient);
  EXPECT_EQ(rotation.angle_origin, AngleOrigin::first_direction);
  expect_near(rotation.normal, {0, 0, -1});
}

TEST(Angles, BeginWithinAQuarterTurnAndGoOnWithoutJumps) {
  for (const double start : {0.3, -1.2, 0.5 * pi, 2.0, pi, -2.5}) {
    std::vector<Vec3> ends;
    for (int i = 0; i < 100; ++i) ends.push_back({std::cos(start + 0.1 * i), -std::sin(start + 0.1 * i), 0.2});
    const auto angle = measure_angles(make_flow_frame(shear_gradient), ends);
    EXPECT_GT(angle.front(), -0.5 * pi + 1e-3);
    EXPECT_LE(angle.front(), 0.5 * pi + 1e-12);
    EXPECT_NEAR(std::sin(2.0 * (angle.front() - start)), 0.0, 1e-12);
    for (int i = 0; i < 100; ++i) EXPECT_NEAR(angle[i] - angle[0], 0.1 * i, 1e-12);
  }
}

TEST(Angles, AreUnsignedWhereTheFlowDoesNotTurnFibers) {
  const std::vector<Vec3> ends{{-1, 1, 0}, {0, 0, 2}, {3, 0, 0}};
  const auto from_axis = measure_angles(make_flow_frame(uniaxial_gradient), ends);
  EXPECT_NEAR(from_axis[0], 0.25 * pi, 1e-14);
  EXPECT_NEAR(from_axis[1], 0.5 * pi, 1e-14);
  EXPECT_NEAR(from_axis[2], 0.0, 1e-14);
  const auto from_first = measure_angles(make_flow_frame({}), ends);
  EXPECT_NEAR(from_first[0], 0.0, 1e-7);
  EXPECT_NEAR(from_first[1], 0.5 * pi, 1e-14);
  EXPECT_NEAR(from_first[2], 0.75 * pi, 1e-14);
}

TEST(Angles, OfAFiberWithoutDirectionAreThoseBefore) {
  const std::vector<Vec3> ends{{0, 0, 1}, {1, -1, 0}, {0, 0, 0}, {1e-12, 5e-12, -1}, {1, -2, 0}};
  const auto angle = measure_angles(make_flow_frame(shear_gradient), ends);
  for (int i = 0; i < 4; ++i) EXPECT_NEAR(angle[i], 0.25 * pi, 1e-14) << i;
  EXPECT_NEAR(angle[4], std::atan(2.0), 1e-14);
}

TEST(PlaneFit, FindsAPlaneToRounding) {
  const Vec3 u = Vec3{1, 2, 2} / 3.0, v = Vec3{2, 1, -2} / 3.0, normal = cross(u, v);
  std::vector<Vec3> points;
  for (int i = 0; i < 40; ++i) points.push_back(Vec3{3, -1, 2} + 0.1 * i * u + 1e-4 * std::sin(0.9 * i) * v);
  const PlaneFit plane = fit_plane(points);
  EXPECT_NEAR(std::abs(dot(plane.normal, normal)), 1.0, 1e-14);
  EXPECT_LT(find_largest_height(points, plane.normal), 1e-14);
  EXPECT_NEAR(std::abs(dot(plane.along, u)), 1.0, 1e-8);
}

TEST(PlaneFit, OfALineIsThePreferredOne) {
  const Vec3 preferred = Vec3{0.1, -0.4, 1.0};
  const std::vector<Vec3> line{{0, 0, 0}, {1, 2, 2}, {2, 4, 4}, {5, 10, 10}}, point(3, Vec3{1, 1, 1});
  const Vec3 normal = fit_plane(line, preferred).normal, direction = Vec3{1, 2, 2} / 3.0;
  EXPECT_NEAR(dot(normal, direction), 0.0, 1e-12);
  const Vec3 nearest = preferred - dot(preferred, direction) * direction;
  EXPECT_NEAR(std::abs(dot(normal, nearest)) / norm(nearest), 1.0, 1e-6);
  EXPECT_NEAR(norm(fit_plane(point).normal), 1.0, 1e-14);
  EXPECT_NEAR(norm(fit_plane({}).normal), 1.0, 1e-14);
}

/// A C whose ends turn by this angle, in the x-y plane or in the x-z plane.
std::vector<Vec3> make_arc(const double turning, const bool is_upright = false) {
  auto line = make_plane_curve(60, 0.002, [=](const double s) { return turning * (s / 0.118 - 0.5); });
  if (is_upright)
    for (Vec3& p : line) p = {p.x, 0.0, p.y};
  return line;
}

FiberHistory make_history(const Matrix3& gradient) {
  FiberConfig config;
  config.sections = 60;
  config.nodes_per_section = 16;
  return {make_fibers({config})[0], make_flow_frame(gradient), 0.4};
}

TEST(Curvature, SignIsThatOfTheFlowWhereItTurnsFibers) {
  FiberHistory history = make_history(shear_gradient), reversed = make_history(make_shear(-2.5, {1, 0, 0}, {0, 1, 0}));
  for (int i = 0; i < 3; ++i) {
    history.add(i, make_arc(0.5 * i - 0.6));
    reversed.add(i, make_arc(0.5 * i - 0.6));
  }
  for (int i = 0; i < 3; ++i) {
    EXPECT_GT((0.5 * i - 0.6) * history.curvature()[60 * i + 30], 0.0);
    EXPECT_EQ(history.curvature()[60 * i + 30], -reversed.curvature()[60 * i + 30]);
  }
}

// The sign is known only when the fiber is bent; what came before is turned over with it.
TEST(Curvature, FirstBendIsPositiveWhereTheFlowDoesNotTurnFibers) {
  for (const double sense : {1.0, -1.0})
    for (const bool is_upright : {false, true}) {
      FiberHistory history = make_history(compression_gradient);
      for (int i = 0; i < 5; ++i) history.add(i, make_arc(sense * 0.03 * (i + 1), is_upright));
      history.add(5, make_arc(-sense * 0.5, is_upright));
      for (int i = 0; i < 5; ++i) EXPECT_GT(history.curvature()[60 * i + 30], 0.0) << i;
      EXPECT_LT(history.curvature()[60 * 5 + 30], 0.0);
      EXPECT_LT(history.shapes()[5].bends.at(0).turning, 0.0);
    }
}

TEST(FiberHistory, HasNoHalfPeriodsWithoutVorticity) {
  FiberHistory history = make_history(uniaxial_gradient), shear = make_history(shear_gradient);
  for (int i = 0; i < 80; ++i) {
    std::vector<Vec3> line;
    for (int s = 0; s < 60; ++s) line.push_back(0.002 * s * Vec3{std::cos(0.1 * i), -std::sin(0.1 * i), 0.3});
    history.add(i, line);
    shear.add(i, line);
  }
  EXPECT_TRUE(history.summarize().half_periods.empty());
  EXPECT_TRUE(history.summarize().passages.empty());
  EXPECT_TRUE(history.out_of_flow_plane().empty());
  EXPECT_EQ(shear.summarize().half_periods.size(), 2u);
  EXPECT_EQ(shear.summarize().tracks.size(), 0u);  // a straight fiber has no extrema of curvature
  EXPECT_EQ(shear.summarize().regime, Regime::tumble);
  EXPECT_LT(shear.summarize().out_of_plane_max, 1e-14);
  EXPECT_NEAR(*shear.summarize().out_of_flow_plane_max, 0.002 * 29.5 * 0.3, 1e-12);
}

}  // namespace
}  // namespace skein
