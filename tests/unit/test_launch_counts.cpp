// What steps and evaluations launch and wait for: on a device each launch costs microseconds, and each wait more.
#include <skein/dynamics/fiber_dynamics.hpp>
#include <skein/dynamics/make_integrator.hpp>
#include <skein/physics/direct_mobility.hpp>
#include <skein/physics/spring_forces.hpp>

#include "runs/observables.hpp"
#include "tests/support/direct_physics.hpp"
#include "tests/support/launch_counts.hpp"
#include "tests/support/nan_trap.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

namespace skein {
namespace {

using test::Counting;
using test::Launches;

/// Many short fibers on a grid, far from each other.
SceneConfig make_scene(const int n_fibers) {
  SceneConfig scene;
  FiberConfig fiber;
  fiber.sections = 3;
  fiber.nodes_per_section = 3;
  fiber.blob = 0.005;
  for (int f = 0; f < n_fibers; ++f) {
    fiber.center = {0.07 * (f % 10), 0.06 * (f / 10 % 10), 0.06 * (f / 100)};
    scene.fibers.push_back(fiber);
  }
  scene.repulsion = {1.0, 0.005};
  scene.time.step = 1e-4;
  return scene;
}

/// Of the second step: what the first sets up is not counted.
Launches count_step(const int n_fibers) {
  const SceneConfig scene = make_scene(n_fibers);
  Physics physics = test::make_direct_physics(scene);
  FiberDynamics dynamics(physics);
  const auto integrator = make_integrator(scene, physics, dynamics);
  State state{0.0, 0, to_device("position", make_surface_nodes(physics.fibers))};
  integrator->advance(state, 1.0);
  const Counting counting;
  const StepReport report = integrator->advance(state, 1.0);
  EXPECT_EQ(report.stages, 2);
  make_step_record(physics, state, report, physics.measure(state.time, state.position));
  make_frame(physics, state.step, state.time, state.position);
  return counting.so_far();
}

TEST(LaunchCounts, OfAStepItsRecordAndItsFrameDoNotGrowWithTheNumberOfFibers) {
  // Few enough for a debugger of memory, enough nodes for sums in which tiles meet (from 256 nodes on).
  const Launches few = count_step(30), many = count_step(75);
  EXPECT_GT(few.kernels, 5) << "the tool is not asked";
  EXPECT_GT(few.reductions, 0);
  EXPECT_EQ(few, many) << many.kernels << " kernels, " << many.reductions << " reductions, " << many.copies
                       << " copies; of fewer fibers " << few.kernels << ", " << few.reductions << ", " << few.copies;
}

TEST(LaunchCounts, OfTheSearchForFaultsIsOneLaunchAndOneWait) {
  for (const int n_fibers : {1, 100}) {
    const Physics physics = test::make_direct_physics(make_scene(n_fibers));
    const Vectors position = to_device("position", make_surface_nodes(physics.fibers));
    const Counting counting;
    EXPECT_EQ(physics.sections.find_faulty_node(position, 2.0), -1);
    EXPECT_EQ(counting.so_far().reductions, 1);
    EXPECT_EQ(counting.so_far().kernels + counting.so_far().copies, 0);
  }
}

// An integrator has its error to wait for, and learns both then.
TEST(LaunchCounts, OfTheSearchForFaultsIsNoWaitWhereTheCallerHasOne) {
  const test::MeantNan not_a_number_is_meant;
  Physics physics = test::make_direct_physics(make_scene(3));
  FiberDynamics dynamics(physics);
  const std::vector<Vec3> good = make_surface_nodes(physics.fibers);
  std::vector<Vec3> bad = good;
  bad[7].y = std::nan("");
  const Vectors position = to_device("position", good), other = to_device("other", bad);
  {
    const Counting counting;
    dynamics.seek_fault(other);
    EXPECT_EQ(counting.so_far(), (Launches{.reductions = 1}));
  }
  ExecSpace().fence();
  {
    const Counting counting;
    EXPECT_NE(dynamics.find_fault(other).find("node 7"), std::string::npos);
    EXPECT_EQ(counting.so_far().reductions, 0);
  }
  // What was sought serves once, and for the positions that it was sought at.
  dynamics.seek_fault(other);
  EXPECT_EQ(dynamics.find_fault(position), "");
  Kokkos::deep_copy(other, position);
  EXPECT_EQ(dynamics.find_fault(other), "");
}

// Centreline, gap and nodes in surfaces: three kernels locate sections for all of them.
TEST(LaunchCounts, OfTheLookAtSectionsAreFiveACopyAndOneWait) {
  for (const int n_fibers : {1, 100}) {
    const Physics physics = test::make_direct_physics(make_scene(n_fibers));
    const Vectors position = to_device("position", make_surface_nodes(physics.fibers));
    const Counting counting;
    const SectionRecord record = physics.sections.look(position);
    EXPECT_EQ(counting.so_far().kernels, 3);
    EXPECT_EQ(counting.so_far().reductions, 2);
    EXPECT_EQ(counting.so_far().waits, 1);
    EXPECT_EQ(record.centreline.size(), 3u * static_cast<unsigned>(n_fibers));
  }
}

// Sections, energies of springs, repulsion and weight, and the largest strain: all are waited for together. The
// springs' energies of nodes and their strain are one launch, those of sections another.
TEST(LaunchCounts, OfWhatAStepsRecordMeasuresIsOneWait) {
  SceneConfig scene = make_scene(20);
  scene.gravity.weight = 0.1;
  const Physics physics = test::make_direct_physics(scene);
  const Vectors position = to_device("position", make_surface_nodes(physics.fibers));
  const Counting counting;
  const StepMeasures measures = physics.measure(0.0, position);
  const Launches counted = counting.so_far();
  EXPECT_EQ(counted.waits, 1);
  EXPECT_EQ(counted.fences, 0);
  EXPECT_EQ(counted.reductions, 3);
  EXPECT_LE(counted.kernels, 9);
  EXPECT_EQ(measures.energy, physics.compute_energies(0.0, position));
  EXPECT_EQ(measures.largest_strain, physics.forces.front()->compute_largest_strain(position));
  EXPECT_EQ(measures.sections.smallest_gap, physics.sections.compute_smallest_gap(position));
}

/// A piece of the paper's fibers: what is launched does not depend on its length.
SceneConfig make_short_scene() {
  SceneConfig scene;
  scene.fibers.emplace_back();
  scene.fibers.front().sections = 12;
  return scene;
}

/// Its sums and springs as GPUs make them.
Physics make_device_physics(const SceneConfig& scene) {
  Physics physics = make_physics(scene);
  physics.mobility = std::make_unique<DirectMobility>(physics.viscosity, Precision::in_double, KernelPath::device);
  physics.forces.front() = std::make_unique<SpringForces>(physics.fibers, KernelPath::device);
  return physics;
}

// Flow, springs, pairs, and their partial sums. Nothing is filled with zeros, nothing comes to the host.
TEST(LaunchCounts, OfAnEvaluationByDirectSumsOnADeviceAreFourAndNoWait) {
  const SceneConfig scene = make_short_scene();
  Physics physics = make_device_physics(scene);
  FiberDynamics dynamics(physics);
  const Vectors position = to_device("position", make_surface_nodes(physics.fibers));
  const Vectors velocity("velocity", position.extent(0));
  dynamics.compute_velocity(0.0, position, velocity);
  const Counting counting;
  dynamics.compute_velocity(0.0, position, velocity);
  EXPECT_EQ(counting.so_far(), (Launches{.kernels = 4}));
}

struct CountedStep {
  int stages = 0;
  Launches launches;
};

/// Of RKC2's second step.
CountedStep count_rkc2_step(const double dt) {
  SceneConfig scene = make_short_scene();
  scene.time.step = dt;
  Physics physics = make_device_physics(scene);
  FiberDynamics dynamics(physics);
  const auto integrator = make_integrator(scene, physics, dynamics);
  State state{0.0, 0, to_device("position", make_surface_nodes(physics.fibers))};
  integrator->advance(state, 1.0);
  const Counting counting;
  const int stages = integrator->advance(state, 1.0).stages;
  return {stages, counting.so_far()};
}

// A stage is an evaluation and one combination; a step has a wait, for its error and for faults.
TEST(LaunchCounts, OfAStageOfRkc2OnADeviceAreFiveAndNoWait) {
  const CountedStep few = count_rkc2_step(1e-3), many = count_rkc2_step(4e-3);
  const int more = many.stages - few.stages;
  ASSERT_GT(more, 2);
  EXPECT_EQ(many.launches.kernels - few.launches.kernels, 5 * more);
  EXPECT_EQ(many.launches.reductions, few.launches.reductions);
  EXPECT_EQ(many.launches.copies, few.launches.copies);
  EXPECT_EQ(many.launches.fences, few.launches.fences);
  EXPECT_EQ(few.launches.reductions, 1) << "faults";
}

}  // namespace
}  // namespace skein
