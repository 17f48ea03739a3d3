// When flows and forces change by themselves, and what of it limits steps.

#include <skein/core/time_course.hpp>
#include <skein/physics/physics.hpp>
#include <skein/physics/scene_flow.hpp>

#include "tests/reference/point_cloud.hpp"
#include "tests/support/force_rows.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

namespace skein {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

std::vector<double> list_breaks(const TimeCourse& course) {
  std::vector<double> breaks;
  for (double time = course.next_break(0.0); time < infinity; time = course.next_break(time)) breaks.push_back(time);
  return breaks;
}

TimeCourse course_of(const FlowConfig& flow) {
  TimeCourse course;
  SceneFlow({flow}).add_course(course);
  return course;
}

TEST(TimeCourse, IsSteadyWhereNothingIsSaid) {
  const TimeCourse steady;
  EXPECT_EQ(steady.next_break(0.0), infinity);
  EXPECT_EQ(steady.longest_step(3.0), infinity);
  EXPECT_FALSE(steady.is_break(0.0));
}

TEST(TimeCourse, BreaksAtTheEndsOfPieces) {
  TimeCourse course;
  course.add_piece(0.0, 2.0);
  course.add_piece(1.0, infinity, 0.25);
  course.add_piece(5.0, 5.0, 1e-3);  // of no length
  EXPECT_EQ(list_breaks(course), (std::vector<double>{1.0, 2.0}));
  EXPECT_TRUE(course.is_break(2.0));
  EXPECT_FALSE(course.is_break(std::nextafter(2.0, 3.0)));
  EXPECT_EQ(course.longest_step(0.5), infinity);
  EXPECT_EQ(course.longest_step(1.0), 0.25);
  EXPECT_EQ(course.longest_step(5.0), 0.25);
}

// A rise of less than the rounding of its time does not stop the clock.
TEST(TimeCourse, LetsTheClockGoOn) {
  TimeCourse course;
  const double start = 1e6, end = std::nextafter(start, infinity);
  course.add_ramp(start, end);
  EXPECT_GT(start + course.longest_step(start), start);
  EXPECT_EQ(course.next_break(start), end);
}

TEST(FlowCourse, OfASteadyFlowIsEmpty) {
  FlowConfig flow;
  EXPECT_TRUE(list_breaks(course_of(flow)).empty());
  EXPECT_EQ(course_of(flow).longest_step(1.0), infinity);
  flow.start = 1.0, flow.stop = 2.0, flow.rate = 0.0;  // it never flows
  EXPECT_TRUE(list_breaks(course_of(flow)).empty());
}

TEST(FlowCourse, HoldsStartStopAndTheEndsOfRamps) {
  FlowConfig flow;
  flow.start = 0.52, flow.stop = 0.525;
  EXPECT_EQ(list_breaks(course_of(flow)), (std::vector<double>{0.52, 0.525}));
  flow.ramp = 0.25, flow.stop = 2.0;
  EXPECT_EQ(list_breaks(course_of(flow)), (std::vector<double>{0.52, 0.52 + 0.25, 2.0, 2.25}));
  EXPECT_EQ(course_of(flow).longest_step(0.6), 0.25 / 8.0);
  EXPECT_EQ(course_of(flow).longest_step(1.0), infinity);
  EXPECT_EQ(course_of(flow).longest_step(2.1), 0.25 / 8.0);
  flow.angular_frequency = -40.0;
  EXPECT_EQ(course_of(flow).longest_step(1.0), 2.0 * std::numbers::pi / 40.0 / 16.0);
  EXPECT_EQ(course_of(flow).longest_step(0.1), infinity);  // before it starts
  EXPECT_EQ(course_of(flow).longest_step(3.0), infinity);  // and once it has stopped
}

// Within a piece, the rate is what a polynomial through a few of its values says, over each step that is allowed.
TEST(FlowCourse, LeavesNothingBetweenBreaksThatStepsWouldNotSee) {
  reference::Random random(5);
  for (int trial = 0; trial < 200; ++trial) {
    FlowConfig flow;
    if (random.uniform(0.0, 1.0) < 0.7) flow.start = random.log_uniform(1e-3, 1.0);
    if (random.uniform(0.0, 1.0) < 0.7) flow.stop = flow.start + random.log_uniform(1e-6, 1.0);
    if (random.uniform(0.0, 1.0) < 0.7) flow.ramp = random.log_uniform(1e-6, 1.0);
    if (random.uniform(0.0, 1.0) < 0.5) flow.angular_frequency = random.log_uniform(1.0, 1e3);
    const TimeCourse course = course_of(flow);
    for (int sample = 0; sample < 50; ++sample) {
      const double from = random.uniform(0.0, 3.0);
      const double before = std::nextafter(course.next_break(from), 0.0);
      const double to = std::min({before, from + course.longest_step(from), from + 0.5});
      const auto rate = [&](const double share) { return compute_rate(flow, from + share * (to - from)) / flow.rate; };
      // By the cubic through four points; the rate between them changes by up to 2, of a smooth one that leaves little.
      const double cubic = (-rate(0.0) + 9.0 * rate(1.0 / 3) + 9.0 * rate(2.0 / 3) - rate(1.0)) / 16.0;
      EXPECT_NEAR(rate(0.5), cubic, 2e-3) << "from " << from << " to " << to;
    }
  }
}

TEST(PhysicsCourse, IsThatOfFlowsAndForces) {
  SceneConfig scene;
  scene.fibers.resize(2);
  for (const auto& row : test::force_rows) {
    SceneConfig with = scene;
    row.configure(with);
    if (with.fibers[0].model == FiberModel::tube) scene = with;  // no torque turns a chain
  }
  scene.flows[0].stop = 7.0;
  const TimeCourse course = make_physics(scene).make_time_course();
  EXPECT_EQ(list_breaks(course), (std::vector<double>{7.0}));
  EXPECT_EQ(course.longest_step(0.0), 2.0 * std::numbers::pi / 3.1 / 16.0);  // of the tether's swing
}

}  // namespace
}  // namespace skein
