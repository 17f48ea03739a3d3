// Shapes and regimes of synthetic centrelines, one of each kind.
#include <skein/analysis/fiber_history.hpp>

#include "known_curves.hpp"
#include "known_flows.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace skein {
namespace {

constexpr double pi = std::numbers::pi;
constexpr double radius = 0.005, spacing = 0.002;
constexpr int n_sections = 200;
constexpr double length = (n_sections - 1) * spacing;

using TangentAngle = std::function<double(double)>;

std::vector<Vec3> make_curve(const TangentAngle& angle) { return make_plane_curve(n_sections, spacing, angle); }

Regime regime_of(const std::vector<Vec3>& line) { return classify_shape(measure_shape(line, 2), radius); }

/// The tangent turns by `turning` about `place`, smoothly within `width`.
double bend(const double s, const double place, const double width, const double turning) {
  return turning * (0.5 + 0.5 * std::tanh((s - place) / (0.5 * width)));
}

/// Hooks at both ends, odd about the middle.
TangentAngle make_snake(const double place, const double turning) {
  return [=](const double s) { return bend(s, place, 0.04, turning) - bend(s, length - place, 0.04, turning); };
}

TEST(Regime, OfEachKindOfShape) {
  EXPECT_EQ(regime_of(make_curve([](double) { return 0.4; })), Regime::tumble);
  EXPECT_EQ(regime_of(make_curve([](const double s) { return 0.2 * std::cos(2.0 * pi * s / length); })),
            Regime::tumble);
  EXPECT_EQ(regime_of(make_curve([](const double s) { return 1.5 * s / length; })), Regime::c_shape);
  EXPECT_EQ(regime_of(make_curve([](const double s) { return 0.8 * std::cos(2.0 * pi * s / length); })),
            Regime::s_shape);
  EXPECT_EQ(regime_of(make_curve(make_snake(0.05, 2.0))), Regime::snake);
  EXPECT_EQ(regime_of(make_curve(make_snake(0.15, 3.4))), Regime::snake);
  EXPECT_EQ(regime_of(make_curve(make_snake(0.15, 2.8))), Regime::s_shape);
  EXPECT_EQ(regime_of(make_curve([](const double s) { return bend(s, 0.06, 0.04, pi); })), Regime::snake);
  EXPECT_EQ(regime_of(make_curve([](const double s) { return 10.0 * s / length; })), Regime::coil);
  auto lifted = make_curve(make_snake(0.05, pi));
  for (int s = 0; s < n_sections; ++s) lifted[s].z = 1.2 * radius * std::sin(9.0 * s / n_sections);
  EXPECT_EQ(regime_of(lifted), Regime::three_dimensional);
}

TEST(Shape, MeasuresWhatIsKnown) {
  // A quarter of a circle.
  const Shape shape = measure_shape(make_curve([](const double s) { return 0.5 * pi * s / length; }), 2);
  const double circle = length / (0.5 * pi);
  EXPECT_NEAR(shape.length, length, 1e-4 * length);
  EXPECT_NEAR(shape.distance, std::sqrt(2.0) * circle, 1e-4 * length);
  EXPECT_NEAR(compute_clockwise_angle(shape.end_to_end, make_flow_frame(shear_gradient)), -0.25 * pi, 1e-4);
  EXPECT_NEAR(std::abs(shape.normal.z), 1.0, 1e-12);
  EXPECT_NEAR(shape.curvature_max, 1.0 / circle, 1e-3 / circle);
  EXPECT_NEAR(shape.total_turning, 0.5 * pi, 1e-2);
  ASSERT_EQ(shape.bends.size(), 1u);
  EXPECT_NEAR(shape.bends[0].turning, 0.5 * pi, 1e-2);
}

TEST(Shape, SymmetryDefectIsTheEvenPart) {
  EXPECT_LT(compute_symmetry_defect(make_curve(make_snake(0.05, pi))), 1e-12);
  // A straight line with a parabola y = a (4 t^2 - 1/3 + ...) on it: the even part about its mean, mean square 16/45 of
  // that of 2 t in [-1/2, 1/2].
  std::vector<Vec3> line;
  const double a = 1e-4;
  for (int s = 0; s < 2001; ++s) {
    const double t = s / 2000.0 - 0.5;
    line.push_back({2.0 * t, a * 4.0 * t * t + 0.3 * a * t, 0.0});
  }
  EXPECT_NEAR(compute_symmetry_defect(line), a * std::sqrt(1.0 / 5.0 - 1.0 / 9.0) / 2.0, 1e-3 * a);
}

// Of the best plane, wherever it lies: a parabola is plane, a cubic across it is not.
TEST(Shape, OutOfPlaneIsMeasuredFromTheOwnPlane) {
  std::vector<Vec3> parabola, twisted;
  double largest = 0.0;
  constexpr int n = 2001;
  for (int s = 0; s < n; ++s) {
    const double t = 2.0 * s / (n - 1.0) - 1.0, cubic = 1e-3 * (t * t * t - 0.6 * t);  // at right angles to 1, t, t^2
    parabola.push_back({t, 0.2 * t, 7.0 + 0.25 * t * t});
    twisted.push_back({t, 0.25 * t * t, cubic});
    largest = std::max(largest, std::abs(cubic));
  }
  EXPECT_LT(compute_out_of_plane(parabola), 1e-14);
  EXPECT_NEAR(compute_out_of_plane(twisted), largest, 0.01 * largest);
}

TEST(Regime, AStraightFiberTiltedOutOfThePlaneOfTheFlowIsStraight) {
  auto line = make_curve([](double) { return 0.4; });
  for (Vec3& point : line) point.z += 0.3 * point.x;
  EXPECT_EQ(regime_of(line), Regime::tumble);
}

TEST(Orientation, AnglesAreClockwiseAndUnwrapped) {
  const FlowFrame shear = make_flow_frame(shear_gradient);
  EXPECT_DOUBLE_EQ(compute_clockwise_angle({1.0, -1.0, 0.3}, shear), 0.25 * pi);
  std::vector<double> time, wrapped;
  for (int i = 0; i <= 400; ++i) {
    const double angle = 0.31 + 0.05 * i;
    time.push_back(0.1 * i);
    wrapped.push_back(compute_clockwise_angle({std::cos(angle), -std::sin(angle), 0.0}, shear));
  }
  const auto angle = unwrap_angles(wrapped);
  EXPECT_NEAR(angle.back(), 20.31, 1e-12);
  const auto passages = find_passages(time, angle);
  ASSERT_EQ(passages.size(), 12u);
  for (int i = 0; i < 12; ++i) {
    EXPECT_EQ(passages[i].quarter_turns, i + 1);
    EXPECT_NEAR(passages[i].time, (0.5 * pi * (i + 1) - 0.31) / 0.5, 1e-10);
  }
  const auto periods = find_half_periods(time, angle);  // not aligned at the beginning
  ASSERT_EQ(periods.size(), 5u);
  for (const double period : periods) EXPECT_NEAR(period, 2.0 * pi, 1e-9);
}

TEST(Orientation, TheFirstHalfPeriodCountsFromAnAlignedStart) {
  const std::vector<double> time{0.0, 1.0, 2.0, 3.0}, angle{0.0, 0.5, 2.0, 3.5};
  const auto periods = find_half_periods(time, angle);
  ASSERT_EQ(periods.size(), 1u);
  EXPECT_NEAR(periods[0], 2.0 + (pi - 2.0) / 1.5, 1e-12);
  // Turning the other way is counted backwards.
  const auto passages = find_passages(time, std::vector{0.0, -0.5, -2.0, -3.5});
  ASSERT_EQ(passages.size(), 2u);
  EXPECT_EQ(passages[1].quarter_turns, -2);
}

TEST(Regime, ChangesAreListedWithTheirTimes) {
  const std::vector<double> time{0, 1, 2, 3, 4, 5, 6};
  const auto t = Regime::tumble, s = Regime::s_shape, c = Regime::coil;
  const std::vector<Regime> regime{t, t, s, s, c, s, s};
  const auto all = find_regime_changes(time, regime);
  ASSERT_EQ(all.size(), 4u);
  EXPECT_EQ(all[2].regime, c);
  EXPECT_EQ(all[2].time, 4.0);
  EXPECT_EQ(find_regime_changes(time, regime, 1.5).size(), 2u);  // the coil lasts for 1 only
  EXPECT_EQ(classify_run(regime), s);                            // and for one moment only
  EXPECT_EQ(classify_run(std::vector{t, c, c}), c);
  EXPECT_EQ(classify_run(std::vector{t}), t);
}

// A fiber that folds its ends and lets the hooks run: what a snake turn must be recognized by.
TEST(FiberHistory, RecognizesASnakeTurn) {
  FiberConfig config;
  config.sections = n_sections;
  config.nodes_per_section = 16;
  config.radius = radius;
  FiberHistory history(make_fibers({config})[0], make_flow_frame(shear_gradient), 0.4);
  const double speed = 0.035;
  for (int i = 0; i <= 80; ++i) {
    const double time = 0.05 * i, place = 0.03 + speed * std::max(time - 1.0, 0.0);
    auto line = make_curve(make_snake(place, std::min(time, 1.0) * 3.4));
    for (Vec3& point : line) point.z = 1e-12 * std::exp(2.3 * time) * point.x;
    history.add(time, line);
  }
  const FiberSummary summary = history.summarize();
  EXPECT_EQ(summary.regime, Regime::snake);
  EXPECT_EQ(summary.changes.front().regime, Regime::tumble);
  EXPECT_EQ(summary.changes.back().regime, Regime::snake);
  EXPECT_NEAR(summary.changes.back().time, 1.57 / 3.4, 0.1);
  EXPECT_EQ(summary.wave, Wave::travelling);
  ASSERT_TRUE(summary.snaking.has_value());
  EXPECT_NEAR(summary.snaking->begin, pi / 3.4, 0.1);
  EXPECT_NEAR(summary.snaking->end - summary.snaking->begin, 2.0, 0.051);
  EXPECT_NEAR(summary.snaking->speed, speed, 0.15 * speed);  // 0.15 of the window the hooks still fold
  EXPECT_LT(summary.symmetry_defect_max, 1e-10);
  EXPECT_NEAR(summary.out_of_plane_growth.slope, 2.3, 0.35);
  EXPECT_NEAR(summary.stretch_max, 0.0, 1e-2);
}

// The hooks of one motion, told in another unit of time.
TEST(FiberHistory, MeasuresSnakingOverTheSameStretchInAnyUnitOfTime) {
  FiberConfig config;
  config.sections = n_sections;
  config.nodes_per_section = 16;
  config.radius = radius;
  std::vector<Snaking> found;
  for (const double unit : {1.0, 0x1p20, 0x1p-20}) {
    FiberHistory history(make_fibers({config})[0], make_flow_frame(shear_gradient), 0.4 * unit);
    for (int i = 0; i <= 80; ++i) {
      const double time = 0.05 * i;
      history.add(unit * time,
                  make_curve(make_snake(0.03 + 0.035 * std::max(time - 1.0, 0.0), std::min(time, 1.0) * 3.4)));
    }
    const FiberSummary summary = history.summarize();
    ASSERT_TRUE(summary.snaking.has_value());
    found.push_back(*summary.snaking);
    EXPECT_EQ(found.back().begin, unit * found[0].begin);
    EXPECT_EQ(found.back().end, unit * found[0].end);
    EXPECT_EQ(found.back().hook_radius, found[0].hook_radius);
    EXPECT_NEAR(found.back().speed * unit, found[0].speed, 1e-12 * found[0].speed);
  }
}

// Half a sine that first shrinks, then grows exponentially, and stops where it is no longer small.
TEST(FiberHistory, MeasuresHowFastABendGrows) {
  FiberConfig config;
  config.sections = n_sections;
  config.nodes_per_section = 16;
  config.radius = radius;
  const Fiber fiber = make_fibers({config})[0];
  FiberHistory history(fiber, make_flow_frame(compression_gradient), 0.4);
  const double fiber_length = fiber.length(), rate = 1.7, amplitude = 1e-4 * fiber_length;
  for (int i = 0; i <= 100; ++i) {
    const double time = 0.05 * i;
    const double height =
        std::min(0.3 * fiber_length, amplitude * (std::exp(-4.0 * time) + 0.2 * std::exp(rate * time)));
    std::vector<Vec3> line;
    for (int s = 0; s < n_sections; ++s) {
      const double t = static_cast<double>(s) / (n_sections - 1);
      // Turned about z by an angle with sine 0.6: deflections do not depend on it.
      const double along = t * fiber_length, across = height * std::sin(pi * t);
      line.push_back({0.8 * along - 0.6 * across, 0.6 * along + 0.8 * across, 7.0});
    }
    history.add(time, line);
    const double whole_periods = n_sections - 1;  // the sine's mean square over the sections, ends included
    EXPECT_NEAR(history.shapes().back().deflection, height * std::sqrt(0.5 * whole_periods / n_sections),
                1e-9 * fiber_length);
  }
  const LineFit growth = history.summarize().deflection_growth;
  EXPECT_NEAR(growth.slope, rate, 0.01 * rate);
  EXPECT_GT(growth.determination, 0.9999);
  EXPECT_GE(growth.n_points, 20);
}

TEST(FiberHistory, NoGrowthOfAStraightFiber) {
  FiberConfig config;
  config.sections = n_sections;
  FiberHistory history(make_fibers({config})[0], make_flow_frame(shear_gradient), 0.4);
  for (int i = 0; i < 20; ++i) history.add(0.1 * i, make_curve([](double) { return 0.0; }));
  EXPECT_EQ(history.summarize().deflection_growth.n_points, 0);
}

}  // namespace
}  // namespace skein
