#include <skein/time/euler.hpp>
#include <skein/time/rkc2.hpp>

#include <gtest/gtest.h>

#include "tests/unit/error_code.hpp"
#include "tests/unit/pointwise_right_hand_side.hpp"

#include <cmath>
#include <functional>
#include <memory>

namespace skein {
namespace {

constexpr int n_nodes = 4;
constexpr double start_time = 0.2;

/// An equation and its solution.
struct Problem {
  PointwiseRightHandSide::Velocity velocity;
  std::function<Vec3(double time, int node)> solution;

  std::vector<Vec3> solution_at(const double time) const {
    std::vector<Vec3> list;
    for (int node = 0; node < n_nodes; ++node) list.push_back(solution(time, node));
    return list;
  }
};

double distance(const std::vector<Vec3>& a, const std::vector<Vec3>& b) {
  double sum = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += dot(a[i] - b[i], a[i] - b[i]);
  return std::sqrt(sum / static_cast<double>(a.size()));
}

/// y' = -rate (y - g(t)) + g'(t), with y = g + (y - g)(0) exp(-rate t); one rate per node.
Problem make_forced(const std::function<double(double time, int node)>& rate, const double off_at_start) {
  const auto g = [](const double t, const int node) {
    return Vec3{0.4 * std::sin(1.3 * t + node), 0.2 * t, 0.3 * std::cos(2.1 * t)};
  };
  const auto slope = [](const double t, const int node) {
    return Vec3{0.52 * std::cos(1.3 * t + node), 0.2, -0.63 * std::sin(2.1 * t)};
  };
  const Vec3 off{off_at_start, -0.5 * off_at_start, 0.8 * off_at_start};
  return {
      [=](const double t, const int node, const Vec3 x) { return slope(t, node) - rate(t, node) * (x - g(t, node)); },
      [=](const double t, const int node) { return g(t, node) + std::exp(-rate(t, node) * (t - start_time)) * off; }};
}

Problem make_slow() {
  return make_forced([](double, const int node) { return 0.5 + 0.4 * node; }, 0.6);
}

/// y' = -2 t y^2, y = 1 / (1 / y(0) + t^2).
Problem make_nonlinear() {
  const auto offset = [](const int node) { return Vec3{0.8 + 0.3 * node, 1.7, 2.4}; };
  return {[](const double t, int, const Vec3 x) {
            return (-2.0 * t) * Vec3{x.x * x.x, x.y * x.y, x.z * x.z};
          },
          [=](const double t, const int node) {
            const Vec3 o = offset(node);
            return Vec3{1.0 / (o.x + t * t), 1.0 / (o.y + t * t), 1.0 / (o.z + t * t)};
          }};
}

/// Slow motion of three nodes, and a fourth at rest that would decay at a high rate: many stages, all of which the slow
/// nodes see.
Problem make_stiff_at_rest() {
  const Problem slow = make_slow();
  return {
      [=](const double t, const int node, const Vec3 x) { return node == 3 ? -3000.0 * x : slow.velocity(t, node, x); },
      [=](const double t, const int node) { return node == 3 ? Vec3{} : slow.solution(t, node); }};
}

State make_state(const Problem& problem) {
  State state;
  state.time = start_time;
  state.position = to_device("test::position", problem.solution_at(start_time));
  return state;
}

Rkc2Options make_options() {
  Rkc2Options options;
  options.length_scale = 0.7;
  options.displacement = 1e-6;
  options.max_step = 0.5;
  return options;
}

std::unique_ptr<Integrator> make_fixed(const bool rkc2, RightHandSide& rhs, const double dt) {
  if (!rkc2) return std::make_unique<Euler>(rhs, dt, 0.7, n_nodes);
  Rkc2Options options = make_options();
  options.fixed_step = dt;
  return std::make_unique<Rkc2>(rhs, options, n_nodes);
}

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

TEST(Rkc2, StagesCoverTheSpectrum) {
  EXPECT_EQ(Rkc2::stages_for(0.0, 0.0), 2);
  EXPECT_EQ(Rkc2::stages_for(0.1, 0.01), 2);
  for (const double z : {1.0, 2.0, 5.0, 17.0, 100.0, 1e3, 1e5}) {
    const int stages = Rkc2::stages_for(0.25, 4.0 * z);
    EXPECT_GE(0.6529 * (stages * stages - 1.0), z) << z;                  // 2/3 (s^2 - 1) (1 - 2/15 * 2/13)
    EXPECT_LT(0.6529 * ((stages - 2.0) * (stages - 2.0) - 1.0), z) << z;  // and hardly any to spare
  }
}

/// 12 rates from 1 to 1e4, evenly on a logarithmic scale.
double wide_rate(const int component) { return std::pow(1e4, component / 11.0); }

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
    EXPECT_EQ(report.stages, Rkc2::stages_for(dt, report.spectral_radius));
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

TEST(Integrator, SaysWhatItIs) {
  auto decay = make_decay(wide_rate);
  EXPECT_NE(make_fixed(false, decay, 0.003)->describe().find("0.003"), std::string::npos);
  EXPECT_NE(make_fixed(true, decay, 0.003)->describe().find("0.003"), std::string::npos);
  EXPECT_NE(Rkc2(decay, make_options(), n_nodes).describe().find("0.0001"), std::string::npos);
}

}  // namespace
}  // namespace skein
