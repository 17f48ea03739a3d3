// Fits and curvatures against circles, lines and hooks whose numbers are known.
#include <skein/analysis/circle_fit.hpp>
#include <skein/analysis/hook.hpp>
#include <skein/analysis/line_fit.hpp>
#include <skein/analysis/signed_curvature.hpp>

#include "known_curves.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

namespace skein {
namespace {

constexpr double pi = std::numbers::pi;
constexpr Vec3 z_axis{0.0, 0.0, 1.0};

TEST(LineFit, RecoversALineAndSaysHowMuchItExplains) {
  const std::vector<double> x{1.0, 2.5, 3.0, 7.0}, y{0.2 - 3.0, 0.2 - 7.5, 0.2 - 9.0, 0.2 - 21.0};
  const LineFit exact = fit_line(x, y);
  EXPECT_NEAR(exact.slope, -3.0, 1e-14);
  EXPECT_NEAR(exact.intercept, 0.2, 1e-13);
  EXPECT_NEAR(exact.determination, 1.0, 1e-14);
  // y = x + (1, -1, -1, 1): the disturbance is orthogonal to 1 and x, so it stays as the residual.
  const LineFit disturbed = fit_line(std::vector{-3.0, -1.0, 1.0, 3.0}, std::vector{-2.0, -2.0, 0.0, 4.0});
  EXPECT_NEAR(disturbed.slope, 1.0, 1e-14);
  EXPECT_NEAR(disturbed.rms, 1.0, 1e-14);
  EXPECT_NEAR(disturbed.determination, 20.0 / 24.0, 1e-14);
}

TEST(LineFit, NeedsTwoMoments) {
  EXPECT_TRUE(std::isnan(fit_line(std::vector{2.0, 2.0}, std::vector{1.0, 3.0}).slope));
  EXPECT_TRUE(std::isnan(fit_line({}, {}).slope));
}

TEST(LineFit, GrowthIsThatOfTheLastStretchInsideTheWindow) {
  std::vector<double> time, amplitude;
  for (int i = 0; i < 400; ++i) {
    time.push_back(0.1 * i);
    amplitude.push_back(std::min(1e-3, 1e-14 + 1e-12 * std::exp(0.7 * 0.1 * i)));  // floor, growth, saturation
  }
  const LineFit fit = fit_growth(time, amplitude, 1e-11, 1e-4);
  EXPECT_NEAR(fit.slope, 0.7, 0.7 * 1e-3);
  EXPECT_NEAR(fit.n_points, std::log(1e7) / 0.07, 2.0);
  EXPECT_EQ(fit_growth(time, amplitude, 1.0, 2.0).n_points, 0);
}

TEST(CircleFit, FindsACircleAnywhereInSpace) {
  const Vec3 center{3.0, -2.0, 0.7};
  const Vec3 u = Vec3{1.0, 2.0, 2.0} / 3.0, v = Vec3{2.0, 1.0, -2.0} / 3.0;
  std::vector<Vec3> points;
  for (int i = 0; i < 9; ++i) points.push_back(center + 0.02 * (std::cos(0.3 * i) * u + std::sin(0.3 * i) * v));
  const Circle circle = fit_circle(points);
  EXPECT_NEAR(circle.radius, 0.02, 1e-12);
  EXPECT_LT(norm(circle.center - center), 1e-12);
  EXPECT_NEAR(std::abs(dot(circle.normal, cross(u, v))), 1.0, 1e-12);
  EXPECT_LT(circle.rms, 1e-12);
}

// The algebraic fit alone is biased towards small radii on short noisy arcs; distances have a minimum at the fit.
TEST(CircleFit, MinimizesDistances) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> noise(-0.05, 0.05);
  std::vector<Vec3> points;
  for (int i = 0; i < 30; ++i) {
    const double radius = 2.0 + noise(random);
    points.push_back({5.0 + radius * std::cos(0.05 * i), radius * std::sin(0.05 * i), 0.0});
  }
  const Circle best = fit_circle(points);
  EXPECT_NEAR(best.radius, 2.0, 0.2);
  const auto distances2 = [&](const Vec3 center, const double radius) {
    double sum = 0.0;
    for (const Vec3 p : points) sum += std::pow(norm(p - center) - radius, 2);
    return sum;
  };
  const double least = distances2(best.center, best.radius);
  EXPECT_NEAR(best.rms, std::sqrt(least / 30.0), 1e-9);
  for (const double step : {-1e-3, 1e-3}) {
    EXPECT_GT(distances2(best.center + Vec3{step, 0.0, 0.0}, best.radius), least);
    EXPECT_GT(distances2(best.center + Vec3{0.0, step, 0.0}, best.radius), least);
    EXPECT_GT(distances2(best.center, best.radius + step), least);
  }
}

TEST(CircleFit, ALineHasAnInfiniteRadius) {
  EXPECT_TRUE(std::isinf(fit_circle(std::vector<Vec3>{{0, 0, 0}, {1, 1, 1}, {2, 2, 2}, {5, 5, 5}}).radius));
  EXPECT_TRUE(std::isinf(fit_circle(std::vector<Vec3>{{0, 0, 0}, {1, 1, 1}}).radius));
}

TEST(SignedCurvature, IsPositiveCounterClockwise) {
  const auto line = make_plane_curve(60, 0.01, [](const double s) { return s < 0.3 ? 5.0 * s : 3.0 - 5.0 * s; });
  const auto curvature = compute_signed_curvature(line, 2, z_axis);
  EXPECT_NEAR(curvature[10], 5.0, 1e-2);
  EXPECT_NEAR(curvature[50], -5.0, 1e-2);
  EXPECT_EQ(curvature.front(), curvature[1]);
  const auto from_below = compute_signed_curvature(line, 2, -z_axis);
  EXPECT_EQ(from_below[10], -curvature[10]);
}

TEST(SignedCurvature, ReachIsAShareOfTheRadius) {
  const auto reach = [](const int nodes_per_section, const double radius) {
    FiberConfig config;
    config.nodes_per_section = nodes_per_section;
    config.radius = radius;
    return choose_curvature_reach(make_fibers({config})[0]);
  };
  EXPECT_EQ(reach(18, 0.005), 2);
  EXPECT_EQ(reach(18, 3.0), 2);
  EXPECT_EQ(reach(9, 0.005), 1);
  EXPECT_EQ(reach(6, 0.005), 1);
  EXPECT_EQ(reach(36, 0.005), 4);
}

TEST(Bends, TurnByTheAngleOfTheirTangents) {
  // Half a turn left, then a third of a turn right.
  const auto line = make_plane_curve(
      201, 0.005, [](const double s) { return s < 0.4 ? pi * s / 0.4 : pi - 2.0 * pi / 3.0 * (s - 0.4) / 0.6; });
  const auto arclength = compute_arclength(line);
  EXPECT_NEAR(arclength.back(), 1.0, 1e-3);
  const auto curvature = compute_signed_curvature(line, 1, z_axis);
  const auto bends = find_bends(arclength, curvature, 0.1);
  ASSERT_EQ(bends.size(), 2u);
  EXPECT_NEAR(bends[0].turning, pi, 0.03);
  EXPECT_NEAR(bends[1].turning, -2.0 * pi / 3.0, 0.03);
  EXPECT_NEAR(bends[0].last, 80, 2);
  EXPECT_EQ(bends[1].last, 200);
  EXPECT_NEAR(compute_total_turning(arclength, curvature), pi + 2.0 * pi / 3.0, 0.05);
  EXPECT_EQ(find_bends(arclength, curvature, 2.5).size(), 1u);
}

TEST(Hook, IsTheSemicircleAtAnEnd) {
  // A straight end of 0.03, half a turn of radius 0.02, and a long straight body.
  const double radius = 0.02;
  const auto line = make_plane_curve(
      400, 0.001, [&](const double s) { return pi - std::min(std::max(s - 0.03, 0.0), pi * radius) / radius; });
  const auto arclength = compute_arclength(line);
  const auto curvature = compute_signed_curvature(line, 2, z_axis);
  const auto hook = find_hook(line, arclength, curvature, FiberEnd::first);
  ASSERT_TRUE(hook.has_value());
  EXPECT_NEAR(hook->circle.radius, radius, 1e-3 * radius);
  EXPECT_NEAR(hook->bend.turning, -pi, 0.03);
  EXPECT_GT(hook->arclength, 0.03);
  EXPECT_LT(hook->arclength, 0.03 + pi * radius);
  EXPECT_FALSE(find_hook(line, arclength, curvature, FiberEnd::last).has_value());
  EXPECT_FALSE(find_hook(line, arclength, curvature, FiberEnd::first, 3.5).has_value());
}

}  // namespace
}  // namespace skein
