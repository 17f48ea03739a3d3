#include <skein/core/error.hpp>
#include <skein/solvers/rkc2_stages.hpp>

#include "tests/unit/known_solutions.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace skein {
namespace {

TEST(Rkc2, StagesCoverTheSpectrum) {
  EXPECT_EQ(count_rkc2_stages(0.0, 0.0), 2);
  EXPECT_EQ(count_rkc2_stages(0.1, 0.01), 2);
  for (const double z : {1.0, 2.0, 5.0, 17.0, 100.0, 1e3, 1e5}) {
    const int stages = count_rkc2_stages(0.25, 4.0 * z);
    EXPECT_GE(0.6529 * (stages * stages - 1.0), z) << z;                  // 2/3 (s^2 - 1) (1 - 2/15 * 2/13)
    EXPECT_LT(0.6529 * ((stages - 2.0) * (stages - 2.0) - 1.0), z) << z;  // and hardly any to spare
  }
}

TEST(Rkc2, IsStableAtAThousandTimesTheStepOfEuler) {
  auto decay = make_decay(wide_rate);
  const double dt = 0.1;
  const auto rkc2 = make_fixed(true, decay, dt);
  State state;
  state.position = to_device("test::position", std::vector<Vec3>(n_nodes, Vec3{0.4, -0.4, 0.4}));
  for (int step = 0; step < 200; ++step) {
    const auto before = decay.evaluations();
    const StepReport report = rkc2->advance(state, 1e9);
    EXPECT_NEAR(report.spectral_radius, 1.2e4, 0.03 * 1.2e4);
    EXPECT_EQ(report.stages, count_rkc2_stages(dt, report.spectral_radius));
    if (step % 25 == 7) {  // between estimates of the radius
      EXPECT_EQ(decay.evaluations() - before, report.stages);
    }
    for (const Vec3 x : to_host(ConstVectors(state.position))) ASSERT_LE(norm(x), 0.7);
    if (step == 9) {
      EXPECT_NEAR(to_host(ConstVectors(state.position))[0].x, 0.4 * std::exp(-1.0), 2e-3);
    }
  }
  for (const Vec3 x : to_host(ConstVectors(state.position))) EXPECT_LT(norm(x), 1e-4);
}

/// Error at the end of a run under error control, with its number of steps.
double adaptive_error(const Problem& problem, const double tolerance, const double end, int& n_steps) {
  PointwiseRightHandSide rhs(problem.velocity);
  Rkc2Options options = make_options();
  options.tolerance = tolerance;
  Rkc2 rkc2(rhs, options, n_nodes);
  State state = make_state(problem);
  while (state.time < end) {
    const StepReport report = rkc2.advance(state, end);
    EXPECT_LE(report.error, 1.0);
    EXPECT_LE(report.dt, options.max_step * (1.0 + 1e-12));
  }
  n_steps = static_cast<int>(state.step);
  return distance(to_host(ConstVectors(state.position)), problem.solution_at(end));
}

TEST(Rkc2, MeetsItsTolerance) {
  const double duration = 4.0;
  for (const Problem& problem : {make_slow(), make_nonlinear(), make_stiff_at_rest()}) {
    int n_coarse, n_fine;
    const double coarse = adaptive_error(problem, 1e-3, start_time + duration, n_coarse);
    const double fine = adaptive_error(problem, 1e-5, start_time + duration, n_fine);
    EXPECT_LT(coarse, 10.0 * 1e-3 * 0.7 * duration);
    EXPECT_LT(fine, 10.0 * 1e-5 * 0.7 * duration);
    EXPECT_GT(fine, 1e-3 * 1e-5 * 0.7 * duration);  // nor wastes steps
    EXPECT_GT(n_fine, 3 * n_coarse);
  }
}

// Fast modes far from rest at the start: the first step must see them, the later ones must not.
TEST(Rkc2, LeavesAFastTransientBehind) {
  const Problem problem = make_forced([](double, const int node) { return node == 0 ? 1e4 : 0.7; }, 0.5);
  int n_steps;
  EXPECT_LT(adaptive_error(problem, 1e-4, start_time + 3.0, n_steps), 10.0 * 1e-4 * 0.7 * 3.0);
  EXPECT_LT(n_steps, 1000);
}

TEST(Rkc2, RecoversWhenTheSpectralRadiusJumps) {
  const double jump = start_time + 1.03;
  const Problem problem =
      make_forced([=](const double t, const int node) { return node == 1 ? (t < jump ? 300.0 : 3000.0) : 0.6; }, 0.0);
  PointwiseRightHandSide rhs(problem.velocity);
  Rkc2 rkc2(rhs, make_options(), n_nodes);
  State state = make_state(problem);
  int n_rejected = 0, n_steps_after = 0;
  double radius = 0.0;
  const double end = start_time + 4.0;
  while (state.time < end) {
    const StepReport report = rkc2.advance(state, end);
    n_rejected += report.rejected;
    n_steps_after += state.time > jump;
    radius = report.spectral_radius;
    ASSERT_LT(state.step, 1000);
  }
  EXPECT_GT(n_rejected, 0);
  EXPECT_NEAR(radius, 1.2 * 3000.0, 0.05 * 3600.0);
  EXPECT_LT(n_steps_after, 200);
  EXPECT_LT(distance(to_host(ConstVectors(state.position)), problem.solution_at(end)), 10.0 * 1e-4 * 0.7 * 4.0);
}

// A step that throws leaves an integrator that can be asked again: here a fault that goes away.
TEST(Rkc2, CanGoOnAfterAFault) {
  const Problem sound = make_slow();
  bool broken = false;
  PointwiseRightHandSide rhs([&](const double t, const int node, const Vec3 x) {
    return broken ? Vec3{std::nan(""), 0.0, 0.0} : sound.velocity(t, node, x);
  });
  Rkc2 rkc2(rhs, make_options(), n_nodes);
  State state = make_state(sound);
  for (int step = 0; step < 5; ++step) rkc2.advance(state, 2.0);
  broken = true;
  EXPECT_THROW(rkc2.advance(state, 2.0), Error);
  broken = false;
  while (state.time < 2.0) rkc2.advance(state, 2.0);
  EXPECT_LT(distance(to_host(ConstVectors(state.position)), sound.solution_at(2.0)), 10.0 * 1e-4 * 0.7 * 2.0);
}

}  // namespace
}  // namespace skein
