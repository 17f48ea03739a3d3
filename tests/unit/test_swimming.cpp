// What a swimmer comes to in a period, of made-up frames whose means are known.
#include <skein/physics/rigid_tube.hpp>

#include "runs/swimming.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace skein {
namespace {

constexpr double period = 0.8;

/// Moves at (-0.3, 0.1, 0) besides swaying at the period, and spends 2 + sin^2.
RunAnalysis make_analysis(const double interval, const double end) {
  RunAnalysis analysis;
  analysis.scene.flows = {{.kind = FlowKind::none}};
  analysis.scene.fluid.viscosity = 1.7;
  FiberConfig fiber;
  fiber.sections = 30;
  fiber.nodes_per_section = 6;
  analysis.scene.fibers = {fiber};
  analysis.scene.undulations = {{.curvature = 10.0, .angular_frequency = -2.0 * std::numbers::pi / period, .ramp = 0.5},
                                {.curvature = 3.0, .angular_frequency = 6.0 * std::numbers::pi / period}};
  analysis.fibers = make_fibers(analysis.scene.fibers);
  analysis.forces.resize(1);
  for (int i = 0; i * interval <= end + 1e-12; ++i) {
    const double t = i * interval, angle = 2.0 * std::numbers::pi * t / period;
    ForceRecord record;
    record.middle = {-0.3 * t + 0.05 * std::sin(angle), 0.1 * t + 0.2 * std::cos(angle), 0.0};
    record.power.dissipation = 2.0 + std::sin(angle) * std::sin(angle);
    analysis.time.push_back(t);
    analysis.forces[0].push_back(record);
  }
  return analysis;
}

TEST(Swimming, IsTheMeanOfThePeriodOfTheSlowestWave) {
  for (const double interval : {0.05, 0.8 / 37.0}) {  // the period begins at a frame, and between two
    const RunAnalysis analysis = make_analysis(interval, 2.0);
    const auto swimming = measure_swimming(analysis, 0);
    ASSERT_TRUE(swimming.has_value());
    EXPECT_DOUBLE_EQ(swimming->end, analysis.time.back());
    EXPECT_NEAR(swimming->end - swimming->begin, period, 1e-12);
    const double curved = interval == 0.05 ? 1e-12 : 2e-3;
    EXPECT_NEAR(swimming->velocity.x, -0.3, curved);
    EXPECT_NEAR(swimming->velocity.y, 0.1, curved);
    EXPECT_NEAR(swimming->power, 2.5, 1e-3);
    const double drag = measure_rigid_tube(analysis.fibers[0], 1.7).axial;
    EXPECT_NEAR(swimming->efficiency(), drag * 0.1 / 2.5, 0.01 * drag * 0.1 / 2.5);
  }
}

TEST(Swimming, NeedsAWaveAFluidAtRestAndAWholePeriod) {
  const RunAnalysis whole = make_analysis(0.05, 1.3);
  EXPECT_TRUE(measure_swimming(whole, 0).has_value());
  EXPECT_FALSE(measure_swimming(make_analysis(0.05, 1.25), 0).has_value()) << "before the wave has risen";
  EXPECT_FALSE(measure_swimming(make_analysis(0.13, 2.0), 0).has_value()) << "too few frames";
  RunAnalysis still = whole;
  for (UndulationConfig& wave : still.scene.undulations) wave.angular_frequency = 0.0;
  EXPECT_FALSE(measure_swimming(still, 0).has_value());
  RunAnalysis flowing = whole;
  flowing.scene.flows = {FlowConfig{}};
  EXPECT_FALSE(measure_swimming(flowing, 0).has_value());
  RunAnalysis unknown = whole;
  unknown.forces.clear();
  EXPECT_FALSE(measure_swimming(unknown, 0).has_value());
  RunAnalysis other = whole;
  other.scene.undulations[0].fiber = other.scene.undulations[1].fiber = 1;
  EXPECT_FALSE(measure_swimming(other, 0).has_value());
}

}  // namespace
}  // namespace skein
