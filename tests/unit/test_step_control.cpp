#include <skein/solvers/step_control.hpp>

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace skein {
namespace {

TEST(StepControl, FirstStepFollowsTheError) {
  EXPECT_DOUBLE_EQ(StepControl().after_accepted(0.3, 0.25), 0.3 * 0.8 / 0.5);
  EXPECT_DOUBLE_EQ(StepControl().after_accepted(0.3, 0.64), 0.3);
}

TEST(StepControl, GrowsAtMostFivefold) {
  EXPECT_DOUBLE_EQ(StepControl().after_accepted(0.3, 1e-6), 1.5);
  EXPECT_DOUBLE_EQ(StepControl().after_accepted(0.3, 0.0), 1.5);
}

TEST(StepControl, ExpectsAGrowingErrorToGrowOn) {
  StepControl control;
  control.after_accepted(0.2, 0.1);
  // The error grew from 0.1 to 0.4 with the same step: half of what the error alone allows.
  EXPECT_DOUBLE_EQ(control.after_accepted(0.2, 0.4), 0.2 * (0.8 / std::sqrt(0.4)) * std::sqrt(0.1 / 0.4));
}

TEST(StepControl, DoesNotTrustAFallingError) {
  StepControl control;
  control.after_accepted(0.2, 0.9);
  EXPECT_DOUBLE_EQ(control.after_accepted(0.2, 0.16), 0.2 * 0.8 / 0.4);
}

TEST(StepControl, RejectionCutsTheStep) {
  EXPECT_DOUBLE_EQ(StepControl().after_rejected(0.3, 4.0), 0.3 * 0.4);
  EXPECT_DOUBLE_EQ(StepControl().after_rejected(0.3, 1e8), 0.3 * 0.1);
  EXPECT_DOUBLE_EQ(StepControl().after_rejected(0.3, std::nan("")), 0.3 * 0.1);
  EXPECT_DOUBLE_EQ(StepControl().after_rejected(0.3, std::numeric_limits<double>::infinity()), 0.3 * 0.1);
  // Just over the tolerance: always cut by a fifth at least, or the same attempt would be repeated.
  EXPECT_LE(StepControl().after_rejected(0.3, 1.0 + 1e-12), 0.24 + 1e-12);
}

TEST(StepControl, DoesNotGrowRightAfterARejection) {
  StepControl control;
  control.after_accepted(0.2, 0.5);
  const double dt = control.after_rejected(0.2, 9.0);
  EXPECT_TRUE(control.memory().just_rejected);
  EXPECT_DOUBLE_EQ(control.after_accepted(dt, 1e-4), dt);
  EXPECT_FALSE(control.memory().just_rejected);
  EXPECT_GT(control.after_accepted(dt, 1e-4), dt);
}

// Errors proportional to dt^2: the loop settles where the error is safety^2, from either side and without rejections.
TEST(StepControl, SettlesWithinTheTolerance) {
  for (const double start : {1e-4, 0.029}) {
    StepControl control;
    double dt = start;
    for (int step = 0; step < 30; ++step) {
      const double error = dt * dt / (0.03 * 0.03);
      ASSERT_LE(error, 1.0) << "step " << step;
      dt = control.after_accepted(dt, error);
    }
    EXPECT_NEAR(dt, 0.8 * 0.03, 1e-6);
  }
}

TEST(StepControl, ContinuesFromItsMemory) {
  StepControl control, restored;
  control.after_accepted(0.2, 0.3);
  control.after_rejected(0.25, 3.0);
  restored.restore(control.memory());
  for (const double error : {0.4, 0.2, 0.7, 0.01})
    EXPECT_EQ(restored.after_accepted(0.2, error), control.after_accepted(0.2, error));
}

}  // namespace
}  // namespace skein
