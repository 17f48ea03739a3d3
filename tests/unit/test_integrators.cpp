#include "tests/unit/error_code.hpp"
#include "tests/unit/known_solutions.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace skein {
namespace {

/// Error at the end of a run at a fixed step.
double error_of_run(const bool rkc2, const Problem& problem, const double dt, const double end) {
  PointwiseRightHandSide rhs(problem.velocity);
  const auto integrator = make_fixed(rkc2, rhs, dt);
  State state = make_state(problem);
  while (state.time < end) integrator->advance(state, end);
  EXPECT_EQ(state.step, std::lround((end - start_time) / dt));
  return distance(to_host(ConstVectors(state.position)), problem.solution_at(end));
}

/// Error in the middle of one step from the exact solution.
double error_inside_step(const bool rkc2, const Problem& problem, const double dt) {
  PointwiseRightHandSide rhs(problem.velocity);
  const auto integrator = make_fixed(rkc2, rhs, dt);
  State state = make_state(problem);
  integrator->advance(state, start_time + 10.0);
  const Vectors position("test::position", n_nodes);
  const double time = start_time + 0.37 * dt;
  integrator->interpolate(time, position);
  return distance(to_host(ConstVectors(position)), problem.solution_at(time));
}

struct OrderRow {
  const char* name;
  Problem (*make)();
};

class Order : public ::testing::TestWithParam<OrderRow> {};
class EulerOrder : public Order {};
constexpr OrderRow forced{"forced", make_slow}, nonlinear{"nonlinear", make_nonlinear},
    stiff_at_rest{"stiff_at_rest", make_stiff_at_rest};
const auto name_of_row = [](const auto& row) { return std::string(row.param.name); };
INSTANTIATE_TEST_SUITE_P(, Order, ::testing::Values(forced, nonlinear, stiff_at_rest), name_of_row);
INSTANTIATE_TEST_SUITE_P(, EulerOrder, ::testing::Values(forced, nonlinear), name_of_row);  // the third needs 1e-3

TEST_P(Order, OfRkc2IsTwo) {
  const Problem problem = GetParam().make();
  double last = error_of_run(true, problem, 0.04, start_time + 2.0);
  for (const double dt : {0.02, 0.01, 0.005}) {
    const double error = error_of_run(true, problem, dt, start_time + 2.0);
    EXPECT_NEAR(std::log2(last / error), 2.0, 0.1) << dt;
    last = error;
  }
}

TEST_P(EulerOrder, IsOne) {
  const Problem problem = GetParam().make();
  double last = error_of_run(false, problem, 0.02, start_time + 2.0);
  for (const double dt : {0.01, 0.005, 0.0025}) {
    const double error = error_of_run(false, problem, dt, start_time + 2.0);
    EXPECT_NEAR(std::log2(last / error), 1.0, 0.1) << dt;
    last = error;
  }
}

// One order more than the method: positions between steps are as good as those at steps.
TEST_P(Order, OfInterpolationIsThatOfTheStep) {
  const Problem problem = GetParam().make();
  EXPECT_NEAR(std::log2(error_inside_step(true, problem, 0.02) / error_inside_step(true, problem, 0.01)), 3.0, 0.2);
  EXPECT_NEAR(std::log2(error_inside_step(false, problem, 0.02) / error_inside_step(false, problem, 0.01)), 2.0, 0.2);
}

TEST(Interpolation, MeetsTheStepsAtItsEnds) {
  for (const bool rkc2 : {false, true}) {
    const Problem problem = make_nonlinear();
    PointwiseRightHandSide rhs(problem.velocity);
    const auto integrator = make_fixed(rkc2, rhs, 0.1);
    State state = make_state(problem);
    const Vectors position("test::position", n_nodes);
    for (int step = 0; step < 3; ++step) {
      const double before = state.time;
      const auto from = to_host(ConstVectors(state.position));
      integrator->advance(state, 3.0);
      integrator->interpolate(before, position);
      EXPECT_LT(distance(to_host(ConstVectors(position)), from), 1e-15);
      integrator->interpolate(state.time, position);
      EXPECT_LT(distance(to_host(ConstVectors(position)), to_host(ConstVectors(state.position))), 1e-15);
    }
  }
}

// A velocity linear in time moves nodes along parabolas: method and interpolation of RKC2 are exact for these.
TEST(Interpolation, OfRkc2IsExactForParabolas) {
  const Problem parabola{[](const double t, const int node, Vec3) {
                           return Vec3{0.3 - 1.4 * t, 0.2 * node, 2.2 * t};
                         },
                         [](const double t, const int node) {
                           return Vec3{0.3 * t - 0.7 * t * t, 0.2 * node * t, 1.1 * t * t};
                         }};
  EXPECT_LT(error_inside_step(true, parabola, 0.4), 1e-14);
  EXPECT_LT(error_of_run(true, parabola, 0.25, start_time + 2.0), 1e-13);
}

TEST(Integrator, LandsOnTheEndToTheBit) {
  const Problem problem = make_slow();
  for (const int kind : {0, 1, 2}) {
    PointwiseRightHandSide rhs(problem.velocity);
    std::unique_ptr<Integrator> integrator;
    if (kind < 2)
      integrator = make_fixed(kind == 1, rhs, 0.03);
    else
      integrator = std::make_unique<Rkc2>(rhs, make_options(), n_nodes);
    State state = make_state(problem);
    for (const double end : {0.3, 0.7, 1.0, 1.0 + 1e-9, 2.3}) {
      while (state.time < end) {
        const double before = state.time;
        const std::int64_t step = state.step;
        const StepReport report = integrator->advance(state, end);
        ASSERT_LE(state.time, end);
        ASSERT_GT(state.time, before);
        EXPECT_EQ(state.step, step + 1);
        EXPECT_NEAR(report.dt, state.time - before, 1e-15);
      }
      EXPECT_EQ(state.time, end);
    }
    EXPECT_LT(distance(to_host(ConstVectors(state.position)), problem.solution_at(2.3)), kind == 0 ? 0.03 : 1e-3);
  }
}

TEST(Euler, IsStableBelowTwoOverTheSpectralRadiusOnly) {
  const double rate = 500.0;
  for (const double limit : {1.95, 2.05}) {
    auto decay = make_decay([=](const int component) { return component == 7 ? rate : 0.3 * rate; });
    Euler euler(decay, limit / rate, 0.7, n_nodes);
    State state;
    state.position = to_device("test::position", std::vector<Vec3>(n_nodes, Vec3{0.4, 0.4, 0.4}));
    for (int step = 0; step < 200; ++step) euler.advance(state, 1e9);
    const double size = std::abs(to_host(ConstVectors(state.position))[2].y);
    EXPECT_NEAR(size, 0.4 * std::pow(limit - 1.0, 200), 1e-6 * size);
  }
}

TEST(Euler, ExplainsItsBlowUp) {
  PointwiseRightHandSide decay([](double, const int node, const Vec3 x) { return (node == 2 ? -500.0 : -20.0) * x; },
                               5.0);
  Euler euler(decay, 3.0 / 500.0, 0.7, n_nodes);
  State state;
  state.position = to_device("test::position", std::vector<Vec3>(n_nodes, Vec3{0.4, 0.4, 0.4}));
  std::string message;
  std::vector<Vec3> last;
  std::int64_t n_steps = 0;
  const ExitCode code = code_of(
      [&] {
        for (; n_steps < 100; ++n_steps) {
          last = to_host(ConstVectors(state.position));
          euler.advance(state, 1e9);
        }
      },
      &message);
  EXPECT_EQ(code, ExitCode::numerical);
  EXPECT_EQ(n_steps, 2);  // 0.69, 1.4, 2.8, 5.5: the third step would leave the range
  EXPECT_EQ(state.step, n_steps);
  EXPECT_DOUBLE_EQ(state.time, n_steps * 3.0 / 500.0);
  EXPECT_EQ(to_host(ConstVectors(state.position)), last);
  for (const char* part : {"node 2", "step 3", "0.004", "spectral radius 500", "rkc2"})
    EXPECT_NE(message.find(part), std::string::npos) << part << " in: " << message;
}

TEST(Integrator, KeepsTheLastGoodStateWhenVelocitiesAreNotANumber) {
  for (const double failing : {0.0, 1.0})  // from the start, or later
    for (const int kind : {0, 1, 2}) {
      Problem problem = make_slow();
      const auto sound = problem.velocity;
      problem.velocity = [=](const double t, const int node, const Vec3 x) {
        Vec3 u = sound(t, node, x);
        if (t > failing && node == 2) u.y = std::nan("");
        return u;
      };
      PointwiseRightHandSide rhs(problem.velocity);
      std::unique_ptr<Integrator> integrator;
      if (kind < 2)
        integrator = make_fixed(kind == 1, rhs, 0.07);
      else
        integrator = std::make_unique<Rkc2>(rhs, make_options(), n_nodes);
      State state = make_state(problem);
      double time = 0.0;
      std::int64_t step = 0;
      std::vector<Vec3> position;
      std::string message;
      const ExitCode code = code_of(
          [&] {
            while (state.time < 3.0) {
              time = state.time;
              step = state.step;
              position = to_host(ConstVectors(state.position));
              integrator->advance(state, 3.0);
            }
          },
          &message);
      EXPECT_EQ(code, ExitCode::numerical) << kind;
      EXPECT_FALSE(message.empty());
      EXPECT_EQ(state.time, time);
      EXPECT_EQ(state.step, step);
      EXPECT_EQ(to_host(ConstVectors(state.position)), position);
      EXPECT_EQ(state.step > 0, failing > start_time);
      // A fixed step is taken before the velocity at its end is known.
      EXPECT_LE(state.time, failing > start_time ? failing + (kind < 2 ? 0.07 : 1e-9) : start_time);
      EXPECT_LT(distance(position, problem.solution_at(state.time)), kind == 0 ? 0.05 : 1e-2);
    }
}

TEST(Integrator, SaysWhatItIs) {
  auto decay = make_decay(wide_rate);
  EXPECT_NE(make_fixed(false, decay, 0.003)->describe().find("0.003"), std::string::npos);
  EXPECT_NE(make_fixed(true, decay, 0.003)->describe().find("0.003"), std::string::npos);
  EXPECT_NE(Rkc2(decay, make_options(), n_nodes).describe().find("0.0001"), std::string::npos);
}

TEST(Euler, EndsStepsWhereVelocitiesBreak) {
  const double on = 0.52, off = 0.525, period = 0.3;
  PointwiseRightHandSide rhs([=](const double t, int, Vec3) { return Vec3{t >= on && t < off ? 2.0 : 0.0, 0.0, 0.0}; });
  rhs.course.add_piece(on, off);
  rhs.course.add_oscillation(1.0, 2.0, period);
  Euler euler(rhs, 0.1, 0.7, n_nodes);
  State state;
  state.position = to_device("test::position", std::vector<Vec3>(n_nodes));
  while (state.time < 3.0) {
    const double before = state.time, dt = euler.advance(state, 3.0).dt;
    EXPECT_LE(dt, 0.1001 * (1.0 + 1e-12));
    if (before >= 1.0 && before < 2.0) {
      EXPECT_LE(dt, 1.001 * period / 16.0);
    }
  }
  EXPECT_NEAR(to_host(ConstVectors(state.position))[3].x, 2.0 * (off - on), 1e-15);
}

}  // namespace
}  // namespace skein
