#include <skein/analysis/centreline.hpp>
#include <skein/dynamics/fiber_dynamics.hpp>
#include <skein/physics/background_flow.hpp>
#include <skein/physics/direct_mobility.hpp>
#include <skein/physics/spring_forces.hpp>
#include <skein/solvers/rkc2.hpp>

#include "tests/reference/force_balance.hpp"
#include "tests/reference/regularized_stokeslet_reference.hpp"
#include "tests/support/direct_physics.hpp"

#include <gtest/gtest.h>

#include <cmath>

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

/// Centrelines 0.016 apart in x, where the flow brings them together.
const FiberConfig left = make_config({-0.008, 0.0, 0.001}, {0.0, 1.0, 0.2});
const FiberConfig right = make_config({0.008, 0.001, 0.0}, {0.0, 0.3, 1.0});
const FlowConfig compression{.kind = FlowKind::planar_extension, .rate = 1.7};

struct SimulatedFibers {
  explicit SimulatedFibers(const std::vector<FiberConfig>& configs, const double step = 0.0,
                           const FlowConfig& flow = {}, const RepulsionConfig& repulsion = {})
      : physics(test::make_direct_physics(make_scene(configs, flow, repulsion))),
        fibers(physics.fibers),
        dynamics(physics),
        state{0.0, 0, to_device("position", make_surface_nodes(fibers))},
        integrator(dynamics, make_options(step), count_nodes(fibers)) {}

  static SceneConfig make_scene(const std::vector<FiberConfig>& configs, const FlowConfig& flow,
                                const RepulsionConfig& repulsion) {
    SceneConfig scene;
    scene.fluid.viscosity = viscosity;
    scene.fibers = configs;
    scene.flows = {flow};
    scene.repulsion = repulsion;
    return scene;
  }

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
    physics.compute_forces(state.time, state.position, force);
    return to_host(force);
  }

  double energy() const {
    double sum = 0.0;
    for (const double energy_of_fiber : physics.compute_energies(state.time, state.position)) sum += energy_of_fiber;
    return sum;
  }

  double gap() const { return physics.sections.compute_smallest_gap(state.position); }

  /// Of springs and repulsion: force times velocity, the rate at which their energy falls.
  double power() {
    const Vectors velocity("velocity", state.position.extent(0));
    dynamics.compute_velocity(state.time, state.position, velocity);
    return reference::inner_product(forces(), to_host(velocity));
  }

  Physics physics;
  const std::vector<Fiber>& fibers;
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

/// Energy at the end, less what the power of springs and repulsion says; the mean power is used as the scale.
double find_energy_defect(SimulatedFibers& run, const double step) {
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
  const auto defect = [](const double step) {
    SimulatedFibers run({upper, lower}, step);
    return find_energy_defect(run, step);
  };
  const double coarse = defect(0.005), fine = defect(0.00125);
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
    for (const double e : run.physics.compute_energies(0.0, to_device("position", position))) sum += e;
    return sum;
  };
  EXPECT_NEAR((energy_after(-moment) - energy_after(moment)) / (2.0 * moment), dissipation, 1e-5 * dissipation);
}

const RepulsionConfig repelling{2.6, 0.004};

TEST(RepelledFibers, StayApartWhereOthersGoOnApproaching) {
  SimulatedFibers repelled({left, right}, 0.0, compression, repelling), others({left, right}, 0.0, compression);
  double smallest = repelled.gap();
  EXPECT_GT(smallest, repelling.range);
  for (double time = 0.05; time < 2.0; time += 0.05) {
    repelled.go_to(time);
    others.go_to(time);
    smallest = std::min(smallest, repelled.gap());
  }
  EXPECT_GT(smallest, 0.2 * repelling.range);
  EXPECT_LT(smallest, repelling.range);
  EXPECT_LT(others.gap(), 0.6 * smallest);
  repelled.go_to(5.0);
  others.go_to(5.0);
  EXPECT_GT(repelled.gap(), 0.5 * repelling.range);
  EXPECT_LT(others.gap(), 0.1 * repelling.range);
}

TEST(RepelledFibers, HaveForcesAndTorquesThatBalance) {
  SimulatedFibers run({left, right}, 0.0, compression, repelling);
  run.go_to(1.0);
  const auto force = run.forces(), position = to_host(run.state.position);
  const auto sum = reference::sum_forces(position, force, 0, count_nodes(run.fibers));
  EXPECT_LT(norm(sum.net), 1e-13 * sum.size);
  EXPECT_LT(norm(sum.torque), 1e-13 * sum.moment);
  EXPECT_GT(norm(reference::sum_forces(position, force, 0, run.fibers[0].n_nodes()).net), 1e-2 * sum.size);
}

TEST(RepelledFibers, HaveEnergyBalancesThatCloseAsTheStepsDo) {
  const auto defect = [](const double step) {
    SimulatedFibers run({left, right}, step, compression, repelling);
    run.go_to(0.5);
    EXPECT_LT(run.gap(), repelling.range);
    const auto repulsion = [&run] {
      std::vector<double> energy(2);
      run.physics.forces.back()->add_energies(run.state.time, run.state.position, energy);
      return energy[0] + energy[1];
    };
    const double before = repulsion(), all_before = run.energy();
    const double found = find_energy_defect(run, step);
    EXPECT_GT(std::abs(repulsion() - before), 0.05 * std::abs(run.energy() - all_before));  // it counts
    return found;
  };
  const double coarse = defect(0.005), fine = defect(0.00125);
  EXPECT_LT(fine, 1e-3);
  EXPECT_LT(fine, 0.15 * coarse);
}

TEST(RepelledFibers, MoveToTheBitAsOthersWhileTheyAreApart) {
  SimulatedFibers repelled({left, right}, 0.0, compression, {2.6, 0.001}), others({left, right}, 0.0, compression);
  const auto is_same = [&] {
    return to_host(ConstVectors(repelled.state.position)) == to_host(ConstVectors(others.state.position));
  };
  repelled.go_to(0.3);
  others.go_to(0.3);
  EXPECT_GT(others.gap(), 0.001);
  EXPECT_TRUE(is_same());
  repelled.go_to(2.5);
  others.go_to(2.5);
  EXPECT_FALSE(is_same());
}

TEST(RepelledFibers, AreMultipliedByTheChangeOfAllTheirForces) {
  SimulatedFibers run({left, right}, 0.0, compression, repelling);
  run.go_to(1.0);
  const std::size_t n = run.state.position.extent(0);
  const auto position = to_host(ConstVectors(run.state.position));
  // Every section moves on its own, as a whole: springs within sections would hide the repulsion.
  std::vector<Vec3> v(n);
  for (std::size_t i = 0; i < n; ++i) v[i] = {std::sin(1.3 * static_cast<double>(i / 7)), 0.3, -0.5};
  const double h = 1e-8;
  const auto forces_at = [&](const double by) {
    auto moved = position;
    for (std::size_t i = 0; i < n; ++i) moved[i] = moved[i] + by * v[i];
    run.state.position = to_device("moved", moved);
    return run.forces();
  };
  auto force = forces_at(h);
  const auto below = forces_at(-h);
  for (std::size_t i = 0; i < n; ++i) force[i] = (0.5 / h) * (force[i] - below[i]);
  const Vectors x = to_device("x", position), product("product", n), expected("expected", n);
  DirectMobility(viscosity, Precision::in_double)
      .add_velocity({x, to_device("force", force), to_device("blob", make_blobs(run.fibers))}, x, expected);
  Linearization& a = *run.dynamics.linearization();
  a.set_position(0.0, x);
  a.multiply(to_device("v", v), product);
  const auto found = to_host(ConstVectors(product)), wanted = to_host(ConstVectors(expected));
  double error = 0.0, size = 0.0;
  for (std::size_t i = 0; i < n; ++i) error += norm(found[i] - wanted[i]), size += norm(wanted[i]);
  EXPECT_LT(error, 1e-5 * size);
  // Without the repulsion's share it would be another product.
  SimulatedFibers others({left, right}, 0.0, compression);
  Linearization& b = *others.dynamics.linearization();
  b.set_position(0.0, x);
  b.multiply(to_device("v", v), product);
  const auto without = to_host(ConstVectors(product));
  error = 0.0;
  for (std::size_t i = 0; i < n; ++i) error += norm(without[i] - wanted[i]);
  EXPECT_GT(error, 1e-3 * size);
}

}  // namespace
}  // namespace skein
