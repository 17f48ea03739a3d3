#include <gtest/gtest.h>

#include <cmath>
#include <skein/hydro/direct_mobility.hpp>
#include <skein/model/background_flow.hpp>
#include <skein/model/spring_forces.hpp>
#include <skein/time/fiber_dynamics.hpp>
#include <skein/time/rkc2.hpp>

#include "tests/reference/force_balance.hpp"
#include "tests/reference/regularized_stokeslet_reference.hpp"

// Two fibers that cross in shear: what one does to the other, and what the sum of both may not do.

namespace skein {
namespace {

constexpr double viscosity = 1.3;

FiberConfig make_config(const Vec3 center, const Vec3 direction) {
  FiberConfig config;
  config.sections = 12;
  config.nodes_per_section = 7;
  config.spring_stiffness = 0.004;
  config.blob = 0.0045;
  config.center = center;
  config.direction = direction;
  return config;
}

const FiberConfig upper = make_config({-0.012, 0.007, 0.0}, {1.0, -0.4, 0.5});
const FiberConfig lower = make_config({0.012, -0.007, 0.0}, {1.0, -0.4, -0.5});

struct SimulatedFibers {
  explicit SimulatedFibers(const std::vector<FiberConfig>& configs, const double step = 0.0)
      : fibers(make_fibers(configs)),
        dynamics(fibers, std::make_unique<SpringForces>(fibers), make_background_flow({FlowConfig{}}),
                 std::make_unique<DirectMobility>(viscosity, Precision::in_double)),
        state{0.0, 0, to_device("position", make_surface_nodes(fibers))},
        integrator(dynamics, make_options(step), count_nodes(fibers)) {}

  Rkc2Options make_options(const double step) const {
    Rkc2Options options;
    options.tolerance = 1e-4;
    options.length_scale = fibers[0].length();
    options.time_scale = 0.4;
    options.fixed_step = step;
    options.displacement = 1e-5 * fibers[0].spacing();
    return options;
  }

  void go_to(const double time) {
    while (state.time < time) integrator.advance(state, time);
  }

  std::vector<Vec3> forces() const {
    const Vectors force("force", state.position.extent(0));
    dynamics.springs().compute_forces(state.position, force);
    return to_host(force);
  }

  double energy() const {
    double sum = 0.0;
    for (const double energy_of_fiber : dynamics.springs().compute_energies(state.position)) sum += energy_of_fiber;
    return sum;
  }

  /// Of the springs: force times velocity, the rate at which the elastic energy falls.
  double power() {
    const Vectors velocity("velocity", state.position.extent(0));
    dynamics.compute_velocity(state.time, state.position, velocity);
    return reference::inner_product(forces(), to_host(velocity));
  }

  std::vector<Fiber> fibers;
  FiberDynamics dynamics;
  State state;
  Rkc2 integrator;
};

double largest_distance(const std::vector<Vec3>& a, const std::vector<Vec3>& b, const std::size_t first) {
  double largest = 0.0;
  for (std::size_t i = 0; i < b.size(); ++i) largest = std::max(largest, norm(a[first + i] - b[i]));
  return largest;
}

TEST(TwoFibers, ForcesAndTorquesOfEachBalanceToRounding) {
  SimulatedFibers run({upper, lower});
  run.go_to(1.0);
  const auto force = run.forces(), position = to_host(run.state.position);
  for (const Fiber& fiber : run.fibers) {
    const auto sum = reference::sum_forces(position, force, fiber.first_node, fiber.n_nodes());
    EXPECT_GT(sum.size, 1e-4);
    EXPECT_LT(norm(sum.net), 1e-13 * sum.size);
    EXPECT_LT(norm(sum.torque), 1e-13 * sum.moment);
  }
}

TEST(TwoFibers, TwentyLengthsApartEachMovesAsIfAlone) {
  FiberConfig far = lower;
  far.center.z = 20.0 * make_fibers({far})[0].length();
  SimulatedFibers both({upper, far}), first({upper}), second({far}), near({upper, lower});
  for (SimulatedFibers* run : {&both, &first, &second, &near}) run->go_to(1.0);
  const auto position = to_host(both.state.position);
  const double length = both.fibers[0].length();
  EXPECT_LT(largest_distance(position, to_host(first.state.position), 0), 1e-3 * length);
  EXPECT_LT(largest_distance(position, to_host(second.state.position), first.fibers[0].n_nodes()), 1e-3 * length);
  // Near each other, they do not.
  EXPECT_GT(largest_distance(to_host(near.state.position), to_host(first.state.position), 0), 0.05 * length);
}

/// Elastic energy at the end, less what the power of the springs says; the mean power is used as the scale.
double find_energy_defect(const double step) {
  SimulatedFibers run({upper, lower}, step);
  constexpr double end = 0.5;
  const int n_pairs = static_cast<int>(std::lround(end / (2.0 * step)));
  const double before = run.energy();
  double spent = 0.0, turned_over = 0.0, early = run.power();
  for (int pair = 0; pair < n_pairs; ++pair) {
    const double start = run.state.time;
    run.go_to(start + step);
    const double middle = run.power();
    run.go_to(start + 2.0 * step);
    const double late = run.power();
    const double work = 2.0 * step * (early + 4.0 * middle + late) / 6.0;  // Simpson: as good as the steps, and better
    spent += work;
    turned_over += std::abs(work);
    early = late;
  }
  EXPECT_GT(turned_over, 1e-7);
  return std::abs(run.energy() - before + spent) / turned_over;
}

TEST(TwoFibers, EnergyBalanceClosesAsTheStepsDo) {
  const double coarse = find_energy_defect(0.005), fine = find_energy_defect(0.00125);
  EXPECT_LT(fine, 1e-3);
  EXPECT_LT(fine, 0.15 * coarse);  // second order: 1/16
}

TEST(TwoFibers, InAFluidAtRestTheEnergyFallsByWhatTheFluidDissipates) {
  SimulatedFibers run({upper, lower});
  run.go_to(0.5);
  const auto force = run.forces();
  const Vectors velocity("velocity", force.size());
  const Scalars blob = to_device("blob", make_blobs(run.fibers));
  DirectMobility(viscosity, Precision::in_double)
      .add_velocity({run.state.position, to_device("force", force), blob}, run.state.position, velocity);
  const double dissipation = reference::inner_product(force, to_host(velocity));
  EXPECT_GT(dissipation, 0.0);

  // With the flow switched off, that is the power of the springs: the energy a moment later shows it.
  constexpr double moment = 1e-6;
  const auto energy_after = [&](const double time) {
    auto position = to_host(run.state.position);
    const auto u = to_host(velocity);
    for (std::size_t i = 0; i < position.size(); ++i) position[i] = position[i] + time * u[i];
    double sum = 0.0;
    for (const double e : run.dynamics.springs().compute_energies(to_device("position", position))) sum += e;
    return sum;
  };
  EXPECT_NEAR((energy_after(-moment) - energy_after(moment)) / (2.0 * moment), dissipation, 1e-5 * dissipation);
}

}  // namespace
}  // namespace skein
