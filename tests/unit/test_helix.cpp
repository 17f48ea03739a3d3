// Fibers that are helices at rest: their shape against formulas, and that springs are slack there.
#include <skein/fibers/helix.hpp>
#include <skein/physics/physics.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace skein {
namespace {

constexpr double pi = std::numbers::pi;

FiberConfig make_config(const double pitch, const double taper, const double shaft) {
  FiberConfig config;
  config.sections = 400;
  config.nodes_per_section = 6;
  config.radius = 0.005;
  config.spacing = 0.004;
  config.direction = {0.2, -0.5, 0.7};
  config.center = {0.3, 0.1, -0.2};
  config.roll = 25.0;
  config.helix_radius = 0.05;
  config.helix_pitch = pitch;
  config.helix_taper = taper;
  config.helix_shaft = shaft;
  return config;
}

// Curvature R k^2 / (1 + R^2 k^2) and torsion k / (1 + R^2 k^2), k = 2 pi / pitch; by triple products of its links.
TEST(Helix, HasTheCurvatureTorsionAndPlaceOfItsKeys) {
  for (const double pitch : {0.25, -0.25, 0.6}) {
    const Fiber fiber{make_config(pitch, 0.05, 0.03), 0, 0, 0};
    const auto poses = make_helix(fiber);
    ASSERT_EQ(static_cast<int>(poses.size()), fiber.config.sections);
    const FiberAxes axes = make_fiber_axes(fiber.config.direction, fiber.config.roll);
    const double h = fiber.spacing(), k = 2.0 * pi / pitch, bent = 1.0 + std::pow(0.05 * k, 2);
    const int n = static_cast<int>(poses.size());
    EXPECT_LT(norm(poses[0].center - (fiber.config.center - 0.5 * (n - 1) * h * axes.along)), 1e-14);
    for (int s = 0; s * h < 0.03; ++s) EXPECT_LT(norm(poses[s].axes.along - axes.along), 1e-12) << "the shaft bends";
    for (int s = n / 2; s + 3 < n; s += 17) {
      const Vec3 a = poses[s + 1].center - poses[s].center, b = poses[s + 2].center - poses[s + 1].center,
                 c = poses[s + 3].center - poses[s + 2].center;
      EXPECT_NEAR(norm(a), h, 1e-12);
      const Vec3 ab = cross(a, b), bc = cross(b, c);
      const double curvature = norm(ab) / (h * h * h);
      const double torsion = std::atan2(dot(cross(ab, bc), b) / h, dot(ab, bc)) / h;
      EXPECT_NEAR(curvature, 0.05 * k * k / bent, 0.01 * curvature);
      EXPECT_NEAR(torsion, k / bent, 0.01 * std::abs(torsion)) << "above 0: right-handed";
      const Vec3 from_axis = cross(axes.along, poses[s].center - poses[0].center);
      EXPECT_NEAR(norm(from_axis), 0.05, 0.002);
    }
  }
}

TEST(Helix, SectionsStandAcrossItAndAreNotTwisted) {
  const Fiber fiber{make_config(0.3, 0.0, 0.0), 0, 0, 0};
  const auto poses = make_helix(fiber);
  for (std::size_t s = 0; s < poses.size(); ++s) {
    const FiberAxes& now = poses[s].axes;
    EXPECT_LT(norm(cross(now.along, now.angle_0) - now.angle_90), 1e-10);
    EXPECT_NEAR(norm(now.angle_0), 1.0, 1e-10);
    if (s == 0) continue;
    const FiberAxes& before = poses[s - 1].axes;
    EXPECT_LT(std::abs(dot(now.angle_0, before.angle_90) - dot(now.angle_90, before.angle_0)), 1e-12) << "twist";
    const Vec3 link = poses[s].center - poses[s - 1].center, mean = before.along + now.along;
    EXPECT_LT(norm(cross(link / norm(link), mean / norm(mean))), 1e-3);
  }
}

double energy_of(const SceneConfig& scene, const std::vector<Vec3>& nodes) {
  return make_physics(scene).compute_energies(0.0, to_device("position", nodes))[0];
}

// Rest lengths are those of the bent tube to the second order of the angle between neighbouring sections, so that
// strains are a hundredth of those that the straight tube's springs would have, and energies a ten-thousandth.
TEST(Helix, SpringsAreSlackAtRest) {
  SceneConfig scene;
  scene.flows = {{.kind = FlowKind::none}};
  scene.fibers = {make_config(0.3, 0.08, 0.05)};
  const Physics helix = make_physics(scene);
  const auto nodes = helix.make_start_nodes(1);
  const double at_rest = energy_of(scene, nodes);
  scene.fibers[0].helix_pitch = -0.3;
  const double of_other_hand = energy_of(scene, nodes);
  scene.fibers[0].helix_radius = 0.0;
  const double of_straight = energy_of(scene, nodes);
  EXPECT_LT(at_rest, 1e-3 * of_straight);
  EXPECT_GT(of_other_hand, 0.5 * of_straight);
  EXPECT_EQ(helix.describe_forces(), "1 helix at rest");
}

}  // namespace
}  // namespace skein
