// What every method with error control promises, against equations whose solutions are known.

#include <skein/core/error.hpp>
#include <skein/scene/words.hpp>
#include <skein/solvers/explicit_runge_kutta.hpp>
#include <skein/solvers/tr_bdf2.hpp>

#include "tests/unit/decaying_right_hand_side.hpp"
#include "tests/unit/error_code.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <numbers>

namespace skein {
namespace {

struct Method {
  const char* name;
  double order;
  std::unique_ptr<Integrator> (*make)(RightHandSide&, const Rkc2Options&);
};

const Method methods[] = {
    {"rk4", 4.0,
     [](RightHandSide& rhs, const Rkc2Options& options) -> std::unique_ptr<Integrator> {
       return std::make_unique<ExplicitRungeKutta>(rhs, options, make_classical_runge_kutta(), n_nodes);
     }},
    {"bs3", 3.0,
     [](RightHandSide& rhs, const Rkc2Options& options) -> std::unique_ptr<Integrator> {
       return std::make_unique<ExplicitRungeKutta>(rhs, options, make_bogacki_shampine(), n_nodes);
     }},
    {"rkc2", 2.0,
     [](RightHandSide& rhs, const Rkc2Options& options) -> std::unique_ptr<Integrator> {
       return std::make_unique<Rkc2>(rhs, options, n_nodes);
     }},
    {"trbdf2", 2.0, [](RightHandSide& rhs, const Rkc2Options& options) -> std::unique_ptr<Integrator> {
       return std::make_unique<TrBdf2>(rhs, options, n_nodes);
     }}};

class Controlled : public ::testing::TestWithParam<Method> {};
INSTANTIATE_TEST_SUITE_P(, Controlled, ::testing::ValuesIn(methods),
                         [](const auto& row) { return std::string(row.param.name); });

struct Case {
  const char* name;
  Problem problem;
  std::vector<double> rate;
};

std::vector<Case> make_cases() {
  return {{"slow", make_slow(), {0.5, 0.9, 1.3, 1.7}},
          {"nonlinear", make_nonlinear(), {0.0, 0.0, 0.0, 0.0}},
          {"stiff node at rest", make_stiff_at_rest(), {0.5, 0.9, 1.3, 3000.0}}};
}

double error_at_fixed_step(const Method& method, const Case& one, const double dt, const double end) {
  DecayingRightHandSide rhs(one.problem.velocity, one.rate);
  Rkc2Options options = make_options();
  options.fixed_step = dt;
  options.tolerance = 1e-13;  // of the linear systems
  const auto integrator = method.make(rhs, options);
  State state = make_state(one.problem);
  while (state.time < end) integrator->advance(state, end);
  return distance(to_host(ConstVectors(state.position)), one.problem.solution_at(end));
}

TEST_P(Controlled, HasItsOrder) {
  const Method& method = GetParam();
  for (const Case& one : make_cases()) {
    const bool is_bound = method.order > 2.0 && one.rate[3] > 1e3;  // by stability, to 2.5 / 3000
    if (is_bound) continue;
    const double end = start_time + 1.0;
    const double coarse = error_at_fixed_step(method, one, 0.02, end);
    const double fine = error_at_fixed_step(method, one, 0.01, end);
    EXPECT_NEAR(std::log2(coarse / fine), method.order, 0.2) << one.name << ": " << coarse << ", " << fine;
  }
}

TEST_P(Controlled, SaysWhatScenesCallIt) {
  const Case one = make_cases().front();
  DecayingRightHandSide rhs(one.problem.velocity, one.rate);
  EXPECT_EQ(word_of(GetParam().make(rhs, make_options())->method()), GetParam().name);
}

struct Outcome {
  double error = 0.0;
  int n_steps = 0, n_rejected = 0;
  std::string rejection;
};

Outcome run_adaptively(const Method& method, const Case& one, const double tolerance, const double end) {
  DecayingRightHandSide rhs(one.problem.velocity, one.rate);
  Rkc2Options options = make_options();
  options.tolerance = tolerance;
  const auto integrator = method.make(rhs, options);
  State state = make_state(one.problem);
  Outcome outcome;
  while (state.time < end) {
    const StepReport report = integrator->advance(state, end);
    EXPECT_LE(report.error, 1.0);
    EXPECT_EQ(report.rejected > 0, !report.rejection.empty());
    outcome.n_rejected += report.rejected;
    if (report.rejected > 0) outcome.rejection = report.rejection;
    if (++outcome.n_steps > 50000) break;
  }
  outcome.error = distance(to_host(ConstVectors(state.position)), one.problem.solution_at(end));
  return outcome;
}

TEST_P(Controlled, MeetsItsTolerance) {
  const double duration = 3.0;
  for (const Case& one : make_cases()) {
    const Outcome coarse = run_adaptively(GetParam(), one, 1e-3, start_time + duration);
    const Outcome fine = run_adaptively(GetParam(), one, 1e-5, start_time + duration);
    EXPECT_LT(coarse.error, 10.0 * 1e-3 * 0.7 * duration) << one.name;
    EXPECT_LT(fine.error, 10.0 * 1e-5 * 0.7 * duration) << one.name;
    EXPECT_GT(fine.n_steps, coarse.n_steps) << one.name;
  }
}

// Nodes that drift into a region from which they are thrown out: no step of the size before it can follow.
TEST_P(Controlled, RejectsAndSaysWhy) {
  const double kick = start_time + 1.03, growth = 40.0, wall = 0.1 * kick;
  const Case one{
      "kick",
      {[=](double, int, const Vec3 x) {
         return Vec3{0.1 + growth * std::max(0.0, x.x - wall), 0.0, 0.0};
       },
       [=](const double t, int) {
         return Vec3{t < kick ? 0.1 * t : wall + 0.1 / growth * (std::exp(growth * (t - kick)) - 1.0), 0.0, 0.0};
       }},
      {0.0, 0.0, 0.0, 0.0}};
  const Outcome outcome = run_adaptively(GetParam(), one, 1e-5, start_time + 1.13);
  EXPECT_GT(outcome.n_rejected, 0);
  EXPECT_NE(outcome.rejection.find("times the tolerance"), std::string::npos) << outcome.rejection;
  EXPECT_LT(outcome.error, 2e-3);  // 54 times what it was off by at the wall
}

TEST_P(Controlled, LandsOnTheEndAndInterpolatesInside) {
  for (const Case& one : make_cases()) {
    DecayingRightHandSide rhs(one.problem.velocity, one.rate);
    const auto integrator = GetParam().make(rhs, make_options());
    State state = make_state(one.problem);
    const Vectors inside("test::inside", n_nodes);
    for (const double end : {0.3, 0.7, 1.0 + 1e-9}) {
      while (state.time < end) {
        const double before = state.time;
        integrator->advance(state, end);
        const double time = 0.3 * before + 0.7 * state.time;
        integrator->interpolate(time, inside);
        EXPECT_LT(distance(to_host(ConstVectors(inside)), one.problem.solution_at(time)), 1e-3) << one.name;
      }
      EXPECT_EQ(state.time, end);
    }
  }
}

TEST_P(Controlled, KeepsTheLastGoodStateWhenVelocitiesAreNotANumber) {
  for (const double failing : {0.0, 1.0}) {
    const Problem sound = make_slow();
    const auto velocity = [&](const double t, const int node, const Vec3 x) {
      Vec3 u = sound.velocity(t, node, x);
      if (t > failing && node == 2) u.y = std::nan("");
      return u;
    };
    DecayingRightHandSide rhs(velocity, {0.5, 0.9, 1.3, 1.7});
    const auto integrator = GetParam().make(rhs, make_options());
    State state = make_state(sound);
    double time = 0.0;
    std::vector<Vec3> position;
    std::string message;
    const ExitCode code = code_of(
        [&] {
          while (state.time < 3.0) {
            time = state.time;
            position = to_host(ConstVectors(state.position));
            integrator->advance(state, 3.0);
          }
        },
        &message);
    EXPECT_EQ(code, ExitCode::numerical);
    EXPECT_NE(message.find("node 2"), std::string::npos) << message;
    EXPECT_EQ(state.time, time);
    EXPECT_EQ(to_host(ConstVectors(state.position)), position);
    EXPECT_LE(state.time, std::max(failing, start_time) + 1e-9);
  }
}

TEST(TrBdf2, DampsWhatItDoesNotResolve) {
  const std::vector<double> rate = {1e2, 1e4, 1e6, 1e8};
  DecayingRightHandSide rhs([=](double, const int node, const Vec3 x) { return -rate[node] * x; }, rate);
  Rkc2Options options = make_options();
  options.fixed_step = 0.1;
  options.tolerance = 1e-6;
  TrBdf2 integrator(rhs, options, n_nodes);
  State state;
  state.position = to_device("test::position", std::vector<Vec3>(n_nodes, Vec3{0.4, -0.4, 0.4}));
  for (int step = 0; step < 12; ++step) integrator.advance(state, 1e9);
  for (const Vec3 x : to_host(ConstVectors(state.position))) EXPECT_LT(norm(x), 1e-5);
  EXPECT_LE(rhs.factorizations, 12);
}

TEST(TrBdf2, NeedsALinearization) {
  PointwiseRightHandSide rhs(make_slow().velocity);
  EXPECT_EQ(code_of([&] { TrBdf2(rhs, make_options(), n_nodes); }), ExitCode::internal);
}

/// A velocity that jumps twice, 2 while it is on, and turns into a parabola: no step may see it from both sides.
struct Pulse {
  double on, off;

  double velocity(const double t) const { return t < on ? 0.3 : t < off ? 2.0 : 0.2 - 1.4 * t; }
  double distance_by(const double end) const {
    return 0.3 * (on - start_time) + 2.0 * (off - on) + 0.2 * (end - off) - 0.7 * (end * end - off * off);
  }
};

TEST_P(Controlled, EndsStepsWhereVelocitiesBreak) {
  const double end = start_time + 2.0;
  for (const Pulse pulse : {Pulse{0.52, 0.525}, Pulse{0.3, 0.3 + 1e-9}, Pulse{0.7, 1.9}, Pulse{0.9, 0.9 + 4e-16}})
    for (const double fixed_step : {0.0, 0.07}) {
      DecayingRightHandSide rhs(
          [&](const double t, int, Vec3) {
            return Vec3{pulse.velocity(t), 0.0, 0.0};
          },
          {0.0, 0.0, 0.0, 0.0});
      rhs.course().add_piece(pulse.on, pulse.off);
      Rkc2Options options = make_options();
      options.fixed_step = fixed_step;
      const auto integrator = GetParam().make(rhs, options);
      State state;
      state.time = start_time;
      state.position = to_device("test::position", std::vector<Vec3>(n_nodes));
      const Vectors inside("test::inside", n_nodes);
      bool was_on = false, was_off = false;
      while (state.time < end) {
        const double before = state.time;
        integrator->advance(state, end);
        was_on = was_on || state.time == pulse.on, was_off = was_off || state.time == pulse.off;
        EXPECT_FALSE(before < pulse.on && state.time > pulse.on);
        EXPECT_FALSE(before < pulse.off && state.time > pulse.off);
        if (before < pulse.on) {
          integrator->interpolate(0.5 * (before + state.time), inside);
          EXPECT_NEAR(to_host(ConstVectors(inside))[1].x, 0.3 * (0.5 * (before + state.time) - start_time), 1e-14);
        }
      }
      EXPECT_TRUE(was_on && was_off);
      EXPECT_NEAR(to_host(ConstVectors(state.position))[2].x, pulse.distance_by(end), 1e-13) << pulse.on << fixed_step;
    }
}

// A method keeps its order over a break: evaluations on the other side would leave an error of first order.
TEST_P(Controlled, HasItsOrderBesideABreak) {
  const double jump = 0.7013, end = start_time + 1.0;
  const auto slope = [=](const double t) { return t < jump ? 0.52 * std::cos(1.3 * t) : 3.0 * std::cos(6.0 * t); };
  const double exact =
      0.4 * (std::sin(1.3 * jump) - std::sin(1.3 * start_time)) + 0.5 * (std::sin(6.0 * end) - std::sin(6.0 * jump));
  const auto error_with = [&](const double dt) {
    DecayingRightHandSide rhs(
        [&](const double t, int, Vec3) {
          return Vec3{slope(t), 0.0, 0.0};
        },
        {0.0, 0.0, 0.0, 0.0});
    rhs.course().add_piece(jump, end + 1.0);
    Rkc2Options options = make_options();
    options.fixed_step = dt;
    options.tolerance = 1e-13;
    const auto integrator = GetParam().make(rhs, options);
    State state;
    state.time = start_time;
    state.position = to_device("test::position", std::vector<Vec3>(n_nodes));
    while (state.time < end) integrator->advance(state, end);
    return std::abs(to_host(ConstVectors(state.position))[0].x - exact);
  };
  EXPECT_GT(std::log2(error_with(0.02) / error_with(0.01)), GetParam().order - 0.35);
}

TEST_P(Controlled, SeesEveryOscillation) {
  const double period = 0.05, end = start_time + 1.0;
  for (const double fixed_step : {0.0, 0.07}) {
    DecayingRightHandSide rhs(
        [=](const double t, int, Vec3) {
          return Vec3{0.5 + std::cos(2.0 * std::numbers::pi * t / period), 0.0, 0.0};
        },
        {0.0, 0.0, 0.0, 0.0});
    rhs.course().add_oscillation(0.0, 1e9, period);
    Rkc2Options options = make_options();
    options.fixed_step = fixed_step, options.tolerance = 0.5;
    const auto integrator = GetParam().make(rhs, options);
    State state;
    state.time = start_time;
    state.position = to_device("test::position", std::vector<Vec3>(n_nodes));
    while (state.time < end) EXPECT_LE(integrator->advance(state, end).dt, period / 16.0 * (1.0 + 1e-12));
    EXPECT_NEAR(to_host(ConstVectors(state.position))[0].x, 0.5, 1e-3);
  }
}

// No limit is as good as any: the first step of a fast decay is found, whatever it is tried with.
TEST_P(Controlled, FindsAStepFromAnyStart) {
  const Case one{
      "fast", make_forced([](double, const int node) { return node == 2 ? 200.0 : 0.7; }, 0.3), {0.7, 0.7, 200.0, 0.7}};
  std::vector<std::int64_t> n_steps;
  for (const double max_step : {0.5, 1e10, 1e300, std::numeric_limits<double>::infinity()}) {
    DecayingRightHandSide rhs(one.problem.velocity, one.rate, 10.0);
    Rkc2Options options = make_options();
    options.max_step = max_step, options.time_scale = 30.0, options.tolerance = 1e-3;
    const auto integrator = GetParam().make(rhs, options);
    State state = make_state(one.problem);
    while (state.time < 3.0) ASSERT_NO_THROW(integrator->advance(state, 3.0)) << max_step;
    EXPECT_LT(distance(to_host(ConstVectors(state.position)), one.problem.solution_at(3.0)), 0.1);
    n_steps.push_back(state.step);
  }
  EXPECT_EQ(n_steps[1], n_steps[2]);
  EXPECT_EQ(n_steps[1], n_steps[3]);
}

}  // namespace
}  // namespace skein
