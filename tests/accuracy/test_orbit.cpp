// The L = 0.139 half turn: reference values of tests/reference/orbit.py, which agree with the snapshot times of
// LaGrone, Cortez, Yan and Fauci 2019 (figure 2, first column).

#include <skein/dynamics/make_integrator.hpp>
#include <skein/solvers/euler.hpp>

#include "tests/support/paper_fiber.hpp"

#include <gtest/gtest.h>

namespace skein::test {
namespace {

constexpr int sections = 80;

struct Sample {
  double time, angle;
};

double time_of_angle(const std::vector<Sample>& orbit, const double angle) {
  for (std::size_t i = 1; i < orbit.size(); ++i)
    if (orbit[i - 1].angle < angle && orbit[i].angle >= angle) {
      const double theta = (angle - orbit[i - 1].angle) / (orbit[i].angle - orbit[i - 1].angle);
      return orbit[i - 1].time + theta * (orbit[i].time - orbit[i - 1].time);
    }
  return -1.0;
}

double angle_at(const std::vector<Sample>& orbit, const double time) {
  for (std::size_t i = 1; i < orbit.size(); ++i)
    if (orbit[i].time >= time) {
      const double theta = (time - orbit[i - 1].time) / (orbit[i].time - orbit[i - 1].time);
      return orbit[i - 1].angle + theta * (orbit[i].angle - orbit[i - 1].angle);
    }
  return -1.0;
}

double largest_distance(const std::vector<Vec3>& a, const std::vector<Vec3>& b) {
  double largest = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) largest = std::max(largest, norm(a[i] - b[i]));
  return largest;
}

std::vector<Vec3> run_to(PaperFiber& fiber, Integrator& integrator, const double end) {
  while (fiber.state.time < end) integrator.advance(fiber.state, end);
  return to_host(fiber.state.position);
}

/// The shortest fiber with half of the nodes on a section and about its rigidity, a fifteenth of its pairs: Euler takes
/// 1e5 steps.
SceneConfig make_cheap_scene() {
  SceneConfig scene;
  FiberConfig fiber;
  fiber.sections = 41;
  fiber.nodes_per_section = 9;
  fiber.spring_stiffness = 0.0245;
  fiber.blob = 0.0024;
  scene.fibers = {fiber};
  return scene;
}

std::vector<Vec3> euler_at_6(const double dt) {
  PaperFiber fiber(make_cheap_scene());
  Euler euler(fiber.dynamics, dt, fiber.length(), fiber.n_nodes());
  return run_to(fiber, euler, 6.0);
}

TEST(Orbit, HalfTurnHasTheReferenceTimesAndCostsAnEighthOfEuler) {
  PaperFiber fiber(sections);
  fiber.scene.time.tolerance = 1e-4;
  const auto integrator = make_integrator(fiber.scene, fiber.physics, fiber.dynamics);
  const Vectors interpolated("interpolated", fiber.state.position.extent(0));
  std::vector<Sample> orbit = {{0.0, 0.0}};
  while (orbit.back().angle < 180.0 && fiber.state.time < 12.0) {
    integrator->advance(fiber.state, 12.0);
    // Sampled by the integrator's own interpolation: chords between steps would be off by more than the tolerance.
    for (double t = orbit.back().time + 0.01; t <= fiber.state.time; t += 0.01) {
      integrator->interpolate(t, interpolated);
      orbit.push_back({t, clockwise_angle(fiber.end_to_end(interpolated))});
    }
  }
  EXPECT_NEAR(angle_at(orbit, 4.95), 40.0, 1.5);
  EXPECT_NEAR(time_of_angle(orbit, 90.0), 5.44, 0.05);
  EXPECT_NEAR(time_of_angle(orbit, 180.0), 10.9, 0.1);
  EXPECT_LE(fiber.dynamics.evaluations(), 110000 / 8);
  RecordProperty("evaluations", static_cast<int>(fiber.dynamics.evaluations()));
  std::printf("angle at 4.95: %.2f; vertical at %.3f; half turn %.3f; %lld evaluations\n", angle_at(orbit, 4.95),
              time_of_angle(orbit, 90.0), time_of_angle(orbit, 180.0),
              static_cast<long long>(fiber.dynamics.evaluations()));
}

TEST(OrbitSlow, EulerConvergesToRkc2WithFirstOrder) {
  PaperFiber fiber(make_cheap_scene());
  fiber.scene.time.tolerance = 1e-6;
  const auto integrator = make_integrator(fiber.scene, fiber.physics, fiber.dynamics);
  const auto rkc2 = run_to(fiber, *integrator, 6.0);
  const double coarse = largest_distance(euler_at_6(1.6e-4), rkc2) / fiber.length();
  const double fine = largest_distance(euler_at_6(1.0e-4), rkc2) / fiber.length();
  std::printf("difference to RKC2 at t = 6: %.3e L at dt = 1.6e-4, %.3e L at dt = 1e-4, order %.3f\n", coarse, fine,
              std::log(coarse / fine) / std::log(1.6));
  EXPECT_LT(fine, 3e-3);
  // First order, up to what RKC2 itself is off by, a few times its tolerance. A difference that did not fall with dt,
  // or fell with its square, would miss this bound by a factor of ten.
  EXPECT_NEAR(coarse, 1.6 * fine, 0.06 * coarse);
  EXPECT_GT(coarse, 30.0 * fiber.scene.time.tolerance) << "too close to tell an order";
}

}  // namespace
}  // namespace skein::test
