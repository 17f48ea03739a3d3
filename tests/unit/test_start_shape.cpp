#include <skein/fibers/calibration.hpp>
#include <skein/fibers/spring_network.hpp>
#include <skein/fibers/start_shape.hpp>

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <tuple>

namespace skein {
namespace {

using std::numbers::pi;

FiberConfig make_config() {
  FiberConfig config;
  config.sections = 81;
  config.center = {0.3, -0.2, 0.1};
  config.direction = {1.0, -2.0, 0.5};
  config.roll = 20.0;
  return config;
}

Fiber make_fiber(const FiberConfig& config) { return make_fibers({config})[0]; }

/// Unit vectors that a fiber's bends are measured along: those of a fiber along x without roll, turned with it.
FiberAxes plain_axes(const FiberConfig& config) { return make_fiber_axes(config.direction, 0.0); }

TEST(StartShape, SectionsStayCircularPerpendicularAndASpacingApart) {
  FiberConfig config = make_config();
  config.start_amplitude = 0.05;
  config.start_mode = 3;
  config.start_plane = 35.0;
  config.start_noise = 0.004;
  const Fiber fiber = make_fiber(config);
  const auto poses = make_section_poses(fiber, 5);
  const auto nodes = make_surface_nodes({fiber}, 5);
  Vec3 sum;
  for (int s = 0; s < config.sections; ++s) {
    const auto& [center, axes] = poses[s];
    sum = sum + center;
    if (s > 0) {
      const Vec3 step = center - poses[s - 1].center;
      EXPECT_NEAR(norm(step), fiber.spacing(), 1e-15);
      EXPECT_GT(dot(step, axes.along), 0.98 * fiber.spacing());
    }
    for (int a = 0; a < 18; ++a) {
      const Vec3 arm = nodes[18 * s + a] - center;
      EXPECT_NEAR(norm(arm), config.radius, 1e-15);
      EXPECT_NEAR(dot(arm, axes.along), 0.0, 1e-15);
      EXPECT_NEAR(norm(nodes[18 * s + a] - nodes[18 * s + (a + 1) % 18]), fiber.spacing(), 1e-15);
    }
  }
  EXPECT_LT(norm(sum / 81.0 - config.center), 1e-14);
}

/// Largest distance of a centroid of nodes from the line through the first and the last.
double measure_deflection(const Fiber& fiber) {
  const auto nodes = make_surface_nodes({fiber});
  const int n = fiber.config.nodes_per_section;
  std::vector<Vec3> line(fiber.config.sections);
  for (std::size_t i = 0; i < nodes.size(); ++i) line[i / n] = line[i / n] + nodes[i] / n;
  const Vec3 chord = line.back() - line.front();
  double largest = 0.0;
  for (const Vec3 point : line) {
    const Vec3 d = point - line.front();
    largest = std::max(largest, std::sqrt(std::max(0.0, dot(d, d) - std::pow(dot(d, chord) / norm(chord), 2))));
  }
  return largest;
}

TEST(StartShape, AmplitudeIsTheOneThatWasAskedFor) {
  for (const auto& [sections, mode, amplitude] : {std::tuple{81, 1, 1e-3},
                                                  {81, 2, 0.02},
                                                  {200, 1, 0.2},
                                                  {200, 2, 0.2},
                                                  {200, 3, 0.15},
                                                  {200, 5, 0.08},
                                                  {12, 1, 0.2},
                                                  {9, 2, 0.1},
                                                  {301, 20, 0.01}}) {
    FiberConfig config = make_config();
    config.sections = sections;
    config.start_mode = mode;
    config.start_amplitude = amplitude;
    config.start_plane = 50.0;
    const Fiber fiber = make_fiber(config);
    EXPECT_NEAR(measure_deflection(fiber) / fiber.length(), amplitude, 1e-9) << sections << ' ' << mode;
  }
}

// A slight bend is a sine, measured from the line through the ends; the ends are half a spacing inside the wave.
TEST(StartShape, ASlightBendIsASine) {
  for (const int mode : {1, 2, 5}) {
    FiberConfig config = make_config();
    config.start_mode = mode;
    config.start_amplitude = 1e-4;
    config.start_plane = 50.0;
    const Fiber fiber = make_fiber(config);
    const auto poses = make_section_poses(fiber, 1);
    const FiberAxes axes = plain_axes(config);
    const Vec3 towards = std::cos(50 * pi / 180) * axes.angle_0 + std::sin(50 * pi / 180) * axes.angle_90;
    const auto wave = [&](const int s) { return std::sin(mode * pi * (s + 0.5) / 81); };
    double mean = 0.0, largest = 0.0;
    for (int s = 0; s < 81; ++s) {
      mean += wave(s) / 81;
      largest = std::max(largest, std::abs(wave(s) - wave(0) - s / 80.0 * (wave(80) - wave(0))));
    }
    for (int s = 0; s < 81; ++s) {
      const Vec3 d = poses[s].center - config.center;
      const double expected = 1e-4 * fiber.length() / largest * (wave(s) - mean);
      EXPECT_NEAR(dot(d, towards), expected, 2e-3 * 1e-4 * fiber.length()) << mode << ' ' << s;
      EXPECT_NEAR(norm(d - dot(d, axes.along) * axes.along - dot(d, towards) * towards), 0.0, 1e-16);
    }
  }
}

TEST(StartShape, ElasticEnergyIsThatOfABentBeam) {
  FiberConfig config = make_config();
  config.start_mode = 2;
  config.start_amplitude = 1e-3;
  const Fiber fiber = make_fiber(config);
  const SpringNetwork network = make_spring_network(fiber);
  const double length = fiber.length();
  // The ends lie inside the wave: the line through them is tilted by a share of 0.5 / 81 of the crest's height.
  const double curvature = 1e-3 * (1.0 + 1.6 / 81) * length * std::pow(2 * pi / length, 2);
  const double beam = 0.25 * measure_beam_stiffness(fiber).infinite_bending * curvature * curvature * length;
  EXPECT_NEAR(compute_spring_energy(network, make_surface_nodes({fiber})) / beam, 1.0, 0.01);
}

TEST(StartShape, NoiseFollowsFromSeedAndFiber) {
  FiberConfig config = make_config();
  config.start_noise = 1e-3;
  const auto fibers = make_fibers({config, config});
  const auto deflection = [&](const int fiber, const std::uint64_t seed) {
    std::vector<Vec3> d;
    for (const SectionPose& pose : make_section_poses(fibers[fiber], seed)) d.push_back(pose.center - config.center);
    return d;
  };
  EXPECT_EQ(deflection(0, 3), deflection(0, 3));
  EXPECT_NE(deflection(0, 3), deflection(0, 4));
  EXPECT_NE(deflection(0, 3), deflection(1, 3));
  const FiberAxes axes = plain_axes(config);
  double to_0 = 0.0, to_90 = 0.0;
  for (std::uint64_t seed = 0; seed < 20; ++seed)
    for (const Vec3 d : deflection(0, seed)) {
      to_0 = std::max(to_0, std::abs(dot(d, axes.angle_0)));
      to_90 = std::max(to_90, std::abs(dot(d, axes.angle_90)));
    }
  for (const double largest : {to_0, to_90}) {
    EXPECT_GT(largest, 1e-3 * fibers[0].length());
    EXPECT_LT(largest, bound_start_deflection(fibers[0]));
  }
}

TEST(StartShape, WithoutABendTheFiberIsStraightWhateverTheSeed) {
  const Fiber fiber = make_fiber(make_config());
  EXPECT_EQ(make_surface_nodes({fiber}, 1), make_surface_nodes({fiber}, 2));
  EXPECT_EQ(bound_start_deflection(fiber), 0.0);
}

}  // namespace
}  // namespace skein
