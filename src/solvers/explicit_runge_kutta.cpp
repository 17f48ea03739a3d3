#include <skein/solvers/explicit_runge_kutta.hpp>

#include <algorithm>
#include <utility>

namespace skein {

RungeKuttaTableau make_bogacki_shampine() {
  return {.method = TimeMethod::bs3,
          .name = "Bogacki-Shampine 3(2)",
          .estimate_order = 2.0,
          .node = {0.0, 1.0 / 2.0, 3.0 / 4.0},
          .matrix = {{}, {1.0 / 2.0}, {0.0, 3.0 / 4.0}},
          .weight = {2.0 / 9.0, 1.0 / 3.0, 4.0 / 9.0},
          .error = {-5.0 / 72.0, 1.0 / 12.0, 1.0 / 9.0, -1.0 / 8.0}};
}

RungeKuttaTableau make_classical_runge_kutta() {
  return {.method = TimeMethod::rk4,
          .name = "RK4",
          .estimate_order = 3.0,
          .node = {0.0, 1.0 / 2.0, 1.0 / 2.0, 1.0},
          .matrix = {{}, {1.0 / 2.0}, {0.0, 1.0 / 2.0}, {0.0, 0.0, 1.0}},
          .weight = {1.0 / 6.0, 1.0 / 3.0, 1.0 / 3.0, 1.0 / 6.0},
          .error = {0.0, 0.0, 0.0, 1.0 / 6.0, -1.0 / 6.0}};
}

ExplicitRungeKutta::ExplicitRungeKutta(RightHandSide& rhs, const ControlOptions& options, RungeKuttaTableau tableau,
                                       const int n_nodes)
    : ControlledIntegrator(rhs, options, tableau.name, tableau.estimate_order, n_nodes, rhs.vectors()),
      tableau_(std::move(tableau)) {
  for (std::size_t stage = 1; stage < tableau_.node.size(); ++stage)
    stage_velocity_.push_back(make_vectors("stage_velocity"));
}

void ExplicitRungeKutta::add_stages(const Vectors& target, const double dt, const std::vector<double>& factor) {
  vectors_.combine(target, {{1.0, start_}, {factor[0] * dt, start_velocity_}});
  for (std::size_t stage = 1; stage < factor.size(); ++stage)
    if (factor[stage] != 0.0)
      vectors_.combine(target, {{1.0, target}, {factor[stage] * dt, stage_velocity_[stage - 1]}});
}

ControlledIntegrator::Attempt ExplicitRungeKutta::attempt(const double time, const double dt) {
  const std::size_t n_stages = tableau_.node.size();
  for (std::size_t stage = 1; stage < n_stages; ++stage) {
    add_stages(scratch_, dt, tableau_.matrix[stage]);
    compute_velocity(time + tableau_.node[stage] * dt, scratch_, stage_velocity_[stage - 1]);
  }
  add_stages(end_, dt, tableau_.weight);
  compute_velocity(time + dt, end_, end_velocity_);

  const std::vector<double>& error = tableau_.error;
  vectors_.combine(scratch_, {{error[0] * dt, start_velocity_}, {error[n_stages] * dt, end_velocity_}});
  for (std::size_t stage = 1; stage < n_stages; ++stage)
    if (error[stage] != 0.0)
      vectors_.combine(scratch_, {{1.0, scratch_}, {error[stage] * dt, stage_velocity_[stage - 1]}});
  return {measure_error(scratch_, dt), static_cast<int>(n_stages), ""};
}

ExpectedStep ExplicitRungeKutta::expect_step(const double spectral_radius) const {
  // Rejected attempts among them; the controller keeps away from the edge of stability, 2.5 and 2.8.
  constexpr double evaluations = 4.0, stability = 1.5;
  const double dt = options_.fixed_step > 0.0 ? options_.fixed_step : largest_step();
  return {std::min(dt, stability / spectral_radius), evaluations, evaluations};
}

}  // namespace skein
