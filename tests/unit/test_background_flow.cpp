#include <skein/core/error.hpp>
#include <skein/physics/background_flow.hpp>
#include <skein/physics/linear_flow.hpp>
#include <skein/physics/scene_flow.hpp>
#include <skein/physics/velocity_gradient.hpp>
#include <skein/scene/scene_file.hpp>
#include <skein/scene/words.hpp>

#include "tests/reference/point_cloud.hpp"
#include "tests/unit/error_code.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>

namespace skein {
namespace {

std::vector<Vec3> make_positions(const int n) {
  reference::Random random(5);
  std::vector<Vec3> positions;
  for (int i = 0; i < n; ++i) positions.push_back(random.in_cube(1.3));
  return positions;
}

const std::vector<Vec3> positions = make_positions(40);

/// What the flow adds to a velocity that is not zero.
std::vector<Vec3> added_by(const BackgroundFlow& flow, const double time = 3.7,
                           const std::vector<Vec3>& at = positions) {
  const Vec3 before{0.1, -0.2, 0.3};
  const Vectors velocity = to_device("velocity", std::vector<Vec3>(at.size(), before));
  flow.add_velocity(time, to_device("position", at), velocity);
  std::vector<Vec3> added = to_host(velocity);
  for (Vec3& u : added) u = u - before;
  return added;
}

std::vector<Vec3> added_by(const FlowConfig& flow, const double time = 3.7, const std::vector<Vec3>& at = positions) {
  return added_by(*make_background_flow({flow}), time, at);
}

struct Formula {
  FlowKind kind;
  std::function<Vec3(double rate, double size, Vec3 d)> velocity;
};

/// Written again, with the stream function of the vortices differentiated by hand.
const std::vector<Formula> formulas = {
    {FlowKind::shear,
     [](const double r, double, const Vec3 d) {
       return Vec3{r * d.y, 0, 0};
     }},
    {FlowKind::planar_extension,
     [](const double r, double, const Vec3 d) {
       return Vec3{-r * d.x, r * d.y, 0};
     }},
    {FlowKind::uniaxial_extension,
     [](const double r, double, const Vec3 d) {
       return Vec3{r * d.x, -r * d.y / 2, -r * d.z / 2};
     }},
    {FlowKind::rotation,
     [](const double r, double, const Vec3 d) {
       return cross({0, 0, r}, d);
     }},
    {FlowKind::poiseuille,
     [](const double r, const double h, const Vec3 d) {
       return Vec3{r * (h * h - d.y * d.y) / (2 * h), 0, 0};
     }},
    {FlowKind::vortices,
     [](const double r, const double side, const Vec3 d) {
       const double k = std::numbers::pi / side;
       return Vec3{r / k * std::sin(k * d.x) * std::cos(k * d.y), -r / k * std::cos(k * d.x) * std::sin(k * d.y), 0};
     }},
    {FlowKind::none, [](double, double, Vec3) { return Vec3{}; }},
};

FlowConfig make_config(const FlowKind kind) {
  return {.kind = kind, .rate = -1.7, .center = {0.3, -0.2, 0.6}, .size = 0.45};
}

void expect_near(const Vec3 found, const Vec3 expected) { EXPECT_LT(norm(found - expected), 1e-14); }

/// By central differences over a step, exact but for rounding and (step k)^2 / 6.
VelocityGradient measure_gradient(const BackgroundFlow& flow, const double time, const Vec3 position) {
  constexpr double step = 1e-5;
  VelocityGradient gradient{};
  for (std::size_t j = 0; j < 3; ++j) {
    const Vec3 shift{j == 0 ? step : 0, j == 1 ? step : 0, j == 2 ? step : 0};
    const auto u = added_by(flow, time, {position + shift, position - shift});
    const Vec3 slope = (u[0] - u[1]) / (2 * step);
    gradient[0][j] = slope.x, gradient[1][j] = slope.y, gradient[2][j] = slope.z;
  }
  return gradient;
}

TEST(BackgroundFlow, EveryKindFollowsItsFormula) {
  for (const Formula& formula : formulas) {
    SCOPED_TRACE(word_of(formula.kind));
    const FlowConfig config = make_config(formula.kind);
    const auto added = added_by(config);
    for (std::size_t i = 0; i < positions.size(); ++i)
      expect_near(added[i], formula.velocity(-1.7, 0.45, positions[i] - config.center));
  }
}

TEST(BackgroundFlow, NoKindHasADivergence) {
  constexpr double step = 1e-5;
  for (const Formula& formula : formulas) {
    const FlowConfig config = make_config(formula.kind);
    std::vector<double> divergence(positions.size(), 0.0);
    for (int c = 0; c < 3; ++c) {
      const Vec3 shift{c == 0 ? step : 0, c == 1 ? step : 0, c == 2 ? step : 0};
      auto ahead = positions, behind = positions;
      for (std::size_t i = 0; i < positions.size(); ++i) ahead[i] = ahead[i] + shift, behind[i] = behind[i] - shift;
      const auto u = added_by(config, 0.0, ahead), v = added_by(config, 0.0, behind);
      for (std::size_t i = 0; i < positions.size(); ++i) divergence[i] += dot(u[i] - v[i], shift) / (2 * step * step);
    }
    for (const double value : divergence) EXPECT_NEAR(value, 0.0, 2e-9) << word_of(formula.kind);
  }
}

TEST(BackgroundFlow, ASumIsTheSumOfItsParts) {
  std::vector<FlowConfig> flows;  // more than one launch takes
  std::vector<Vec3> expected(positions.size());
  for (const Formula& formula : formulas) {
    flows.push_back(make_config(formula.kind));
    flows.back().rate = 0.3 + flows.size();
    const auto part = added_by(flows.back());
    for (std::size_t i = 0; i < expected.size(); ++i) expected[i] = expected[i] + part[i];
  }
  const auto sum = make_background_flow(flows);
  const auto added = added_by(*sum);
  for (std::size_t i = 0; i < expected.size(); ++i) EXPECT_LT(norm(added[i] - expected[i]), 1e-13);
  for (const char* word : {"shear", "planar extension", "uniaxial extension", "rotation", "Poiseuille", "vortices"})
    EXPECT_NE(sum->describe().find(word), std::string::npos) << word;
}

TEST(BackgroundFlow, RatesOscillateRiseAndFall) {
  FlowConfig flow = make_config(FlowKind::shear);
  EXPECT_EQ(compute_rate(flow, 100.0), -1.7);

  flow.angular_frequency = 3.0;
  flow.phase = 30.0;
  for (const double t : {0.0, 0.4, 2.9})
    EXPECT_NEAR(compute_rate(flow, t), -1.7 * std::cos(3.0 * t + std::numbers::pi / 6), 1e-15) << t;
  const auto added = added_by(flow, 2.9);
  for (std::size_t i = 0; i < positions.size(); ++i)
    expect_near(added[i], {-1.7 * std::cos(8.7 + std::numbers::pi / 6) * (positions[i].y + 0.2), 0, 0});

  flow = make_config(FlowKind::shear);
  flow.start = 1.0;
  flow.stop = 5.0;
  EXPECT_EQ(compute_rate(flow, 0.99), 0.0);
  EXPECT_EQ(compute_rate(flow, 1.0), -1.7);
  EXPECT_EQ(compute_rate(flow, 4.99), -1.7);
  EXPECT_EQ(compute_rate(flow, 5.0), 0.0);
  flow.ramp = 0.5;
  EXPECT_NEAR(compute_rate(flow, 1.25), -0.85, 1e-15);
  EXPECT_NEAR(compute_rate(flow, 5.25), -0.85, 1e-15);
  EXPECT_NEAR(compute_rate(flow, 1.125), -1.7 * (3.0 / 16 - 2.0 / 64), 1e-15);
  EXPECT_EQ(compute_rate(flow, 6.0), 0.0);
}

TEST(BackgroundFlow, ScalesAreThoseOfTheMotion) {
  FlowConfig shear = make_config(FlowKind::shear), rotation = make_config(FlowKind::rotation);
  rotation.rate = 0.3;
  EXPECT_NEAR(make_background_flow({shear, rotation})->typical_rate(), 1.7, 1e-15);  // a rotation deforms nothing
  EXPECT_NEAR(make_background_flow({shear, rotation})->time_scale(), 0.5, 1e-15);
  shear.angular_frequency = -8.0, rotation.ramp = 0.1;  // are no motion, but a course
  EXPECT_NEAR(make_background_flow({shear, rotation})->time_scale(), 0.5, 1e-15);
  EXPECT_EQ(make_background_flow({make_config(FlowKind::none)})->typical_rate(), 0.0);
  EXPECT_TRUE(std::isinf(make_background_flow({make_config(FlowKind::none)})->time_scale()));
}

TEST(BackgroundFlow, TypicalRateIsTheLargestRateOfDeformation) {
  const auto corner = [](const FlowConfig& flow) {  // where the flow is strongest
    return flow.center + Vec3{0, flow.kind == FlowKind::poiseuille ? flow.size : 0.0, 0};
  };
  for (const Formula& formula : formulas) {
    const FlowConfig config = make_config(formula.kind);
    const auto gradient = measure_gradient(*make_background_flow({config}), 0.0, corner(config));
    double sum = 0.0;
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) sum += std::pow(gradient[i][j] + gradient[j][i], 2) / 2;
    EXPECT_NEAR(make_background_flow({config})->typical_rate(), std::sqrt(sum), 1e-6) << word_of(formula.kind);
  }
}

TEST(BackgroundFlow, IsDescribedInOneLine) {
  EXPECT_EQ(make_background_flow({FlowConfig{}})->describe(), "shear (2.5 y, 0, 0)");
  EXPECT_EQ(make_background_flow({make_config(FlowKind::none)})->describe(), "fluid at rest");
  FlowConfig flow = make_config(FlowKind::planar_extension);
  flow.angular_frequency = 3.0;
  flow.phase = -90.0;
  EXPECT_EQ(make_background_flow({flow})->describe(),
            "planar extension r (-(x - 0.3), (y + 0.2), 0), r = -1.7 cos(3 t -90 degrees)");
}

TEST(BackgroundFlow, UnknownKindNamesTheKnownOnes) {
  try {
    read_scene_text("[fiber]\n[flow]\nkind = \"vortex\"\n", "scene.toml", {});
    FAIL() << "accepted";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ExitCode::scene_error);
    EXPECT_NE(std::string(error.what()).find("vortex"), std::string::npos);
    EXPECT_NE(std::string(error.what()).find("shear"), std::string::npos);
  }
}

TEST(BackgroundFlow, AKindWithoutARowIsNotTakenForAnother) {
  const FlowConfig flow{.kind = static_cast<FlowKind>(99), .rate = 1.0};
  EXPECT_EQ(code_of([&] { make_background_flow({flow}); }), ExitCode::internal);
}

void expect_gradient_of_differences(const BackgroundFlow& flow, const double time) {
  for (std::size_t p = 0; p < positions.size(); p += 4) {
    const VelocityGradient found = flow.gradient(time, positions[p]);
    const VelocityGradient expected = measure_gradient(flow, time, positions[p]);
    for (std::size_t i = 0; i < 3; ++i)
      for (std::size_t j = 0; j < 3; ++j) EXPECT_NEAR(found[i][j], expected[i][j], 1e-8) << i << j;
  }
}

TEST(BackgroundFlow, TheGradientOfEveryKindIsThatOfItsVelocity) {
  std::vector<FlowConfig> all;
  for (const Formula& formula : formulas) {
    SCOPED_TRACE(word_of(formula.kind));
    FlowConfig config = make_config(formula.kind);
    config.angular_frequency = 2.0;
    all.push_back(config);
    expect_gradient_of_differences(*make_background_flow({config}), 0.3);
  }
  expect_gradient_of_differences(*make_background_flow(all), 0.3);
  expect_gradient_of_differences(
      LinearFlow({{{1.5, -2.0, 0.5}, {3.0, -4.0, 0.25}, {7.0, 0.75, 2.5}}}, {1.0, 2.0, -1.0}), 0.0);
}

TEST(LinearFlow, EveryEntryOfTheGradientAndTheOriginCount) {
  const LinearFlow flow({{{1.5, -2.0, 0.5}, {3.0, -4.0, 0.25}, {7.0, 0.75, 2.5}}}, {1.0, 2.0, -1.0});
  const auto added = added_by(flow);
  for (std::size_t i = 0; i < positions.size(); ++i) {
    const Vec3 d = positions[i] - Vec3{1.0, 2.0, -1.0};
    expect_near(added[i], {1.5 * d.x - 2.0 * d.y + 0.5 * d.z, 3.0 * d.x - 4.0 * d.y + 0.25 * d.z,
                           7.0 * d.x + 0.75 * d.y + 2.5 * d.z});
  }
  EXPECT_NE(flow.describe().find("0.75"), std::string::npos);
}

TEST(LinearFlow, TypicalRateIsThatOfShear) {
  EXPECT_NEAR(LinearFlow(make_shear_gradient(-2.2), {}).typical_rate(), 2.2, 1e-15);
  EXPECT_NEAR(LinearFlow(make_planar_extension_gradient(0.8), {}).typical_rate(), 1.6, 1e-15);
  EXPECT_EQ(LinearFlow(make_rotation_gradient(0.8), {}).typical_rate(), 0.0);
}

TEST(LinearFlow, RefusesArraysOfDifferentLength) {
  const LinearFlow flow(make_shear_gradient(2.0), {});
  EXPECT_THROW(flow.add_velocity(0.0, Vectors("position", 3), Vectors("velocity", 2)), Error);
  EXPECT_THROW(make_background_flow({FlowConfig{}})->add_velocity(0.0, Vectors("position", 3), Vectors("velocity", 2)),
               Error);
}

}  // namespace
}  // namespace skein
