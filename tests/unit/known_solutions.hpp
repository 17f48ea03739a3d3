#pragma once

#include <skein/solvers/euler.hpp>
#include <skein/solvers/rkc2.hpp>

#include "tests/unit/pointwise_right_hand_side.hpp"

#include <cmath>
#include <functional>
#include <memory>

namespace skein {

// Equations with known solutions, and integrators for them.

inline constexpr int n_nodes = 4;
inline constexpr double start_time = 0.2;

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

inline double distance(const std::vector<Vec3>& a, const std::vector<Vec3>& b) {
  double sum = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += dot(a[i] - b[i], a[i] - b[i]);
  return std::sqrt(sum / static_cast<double>(a.size()));
}

/// y' = -rate (y - g(t)) + g'(t), with y = g + (y - g)(0) exp(-rate t); one rate per node.
inline Problem make_forced(const std::function<double(double time, int node)>& rate, const double off_at_start) {
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

inline Problem make_slow() {
  return make_forced([](double, const int node) { return 0.5 + 0.4 * node; }, 0.6);
}

/// y' = -2 t y^2, y = 1 / (1 / y(0) + t^2).
inline Problem make_nonlinear() {
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
inline Problem make_stiff_at_rest() {
  const Problem slow = make_slow();
  return {
      [=](const double t, const int node, const Vec3 x) { return node == 3 ? -3000.0 * x : slow.velocity(t, node, x); },
      [=](const double t, const int node) { return node == 3 ? Vec3{} : slow.solution(t, node); }};
}

inline State make_state(const Problem& problem) {
  State state;
  state.time = start_time;
  state.position = to_device("test::position", problem.solution_at(start_time));
  return state;
}

inline Rkc2Options make_options() {
  Rkc2Options options;
  options.length_scale = 0.7;
  options.displacement = 1e-6;
  options.max_step = 0.5;
  return options;
}

inline std::unique_ptr<Integrator> make_fixed(const bool rkc2, RightHandSide& rhs, const double dt) {
  if (!rkc2) return std::make_unique<Euler>(rhs, dt, 0.7, n_nodes);
  Rkc2Options options = make_options();
  options.fixed_step = dt;
  return std::make_unique<Rkc2>(rhs, options, n_nodes);
}

/// 12 rates from 1 to 1e4, evenly on a logarithmic scale.
inline double wide_rate(const int component) { return std::pow(1e4, component / 11.0); }

}  // namespace skein
