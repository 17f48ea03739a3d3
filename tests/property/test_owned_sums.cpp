// Velocities at nodes that ranks own have the bits of those of whole arrays, and of one process.
#include <skein/physics/direct_mobility.hpp>
#include <skein/physics/fmm_mobility.hpp>

#include "tests/property/owned_nodes_case.hpp"

#include <gtest/gtest.h>

namespace skein {
namespace {

using test::Case;
using test::is_same;
using test::make_scene;
using test::Nodes;
using test::read;

/// Velocities of all kinds of sums, from nodes that are owned by ranks and from whole arrays.
TEST(OwnedNodes, HaveTheVelocitiesOfWholeArrays) {
  SceneConfig many = make_scene(120, SumMethod::fmm);
  SceneConfig two_blobs = make_scene(30);
  two_blobs.fibers[1].blob = 0.006;
  for (const SceneConfig& scene : {make_scene(3), make_scene(40), two_blobs, many}) {
    Case made(scene);
    const Nodes start = made.physics.make_start_nodes(1);
    const Vectors position = to_device("position", start), velocity("velocity", start.size());
    const Vectors part = made.part_of(start), velocity_part = made.parts().make("velocity", made.n_nodes);
    // Also in a step, where trees serve several sums, and where some of them are compared with direct ones.
    made.dynamics.begin_step();
    for (int i = 0; i < 9; ++i) {
      made.dynamics.compute_velocity(0.1, position, velocity);
      made.dynamics.compute_velocity(0.1, part, velocity_part);
      ASSERT_TRUE(is_same(made.whole_of(velocity_part), read(velocity))) << i;
      whole_vectors().combine(position, {{1.0, position}, {1e-4, velocity}});
      made.parts().combine(part, {{1.0, part}, {1e-4, velocity_part}});
    }
    made.dynamics.end_step();
    EXPECT_EQ(made.physics.mobility->error_record().n_checks > 0, scene.hydrodynamics.method == SumMethod::fmm);
    EXPECT_GT(whole_vectors().root_mean_square(velocity), 1e-3);
  }
}

/// So many nodes that each rank makes a part of the tree: velocities are those of one process, which has it whole.
/// Where no fiber repels others, ranks get positions of a few nodes besides their own.
class OwnedTreesInParts : public ::testing::TestWithParam<bool> {};

TEST_P(OwnedTreesInParts, HaveTheVelocitiesOfOneProcess) {
  const bool repels = GetParam();
  SceneConfig scene = make_scene(5500, SumMethod::fmm);
  scene.hydrodynamics.check_every = 3;
  if (repels) scene.repulsion.strength = 1.0;
  Case made(scene);
  Physics alone = make_physics(scene);
  FiberDynamics dynamics(alone);
  const Nodes start = alone.make_start_nodes(1);
  const Vectors position = to_device("position", start), velocity("velocity", start.size());
  const Vectors part = made.part_of(start), velocity_part = made.parts().make("velocity", made.n_nodes);
  for (RightHandSide* const each :
       {static_cast<RightHandSide*>(&dynamics), static_cast<RightHandSide*>(&made.dynamics)})
    each->begin_step();
  const Communicator& ranks = test::find_team()->ranks();
  for (int i = 0; i < 5; ++i) {
    dynamics.compute_velocity(0.1, position, velocity);
    const double shared = ranks.traffic().shared_bytes;
    made.dynamics.compute_velocity(0.1, part, velocity_part);
    const double bytes_per_node = (ranks.traffic().shared_bytes - shared) / made.n_nodes;
    if (i == 0 || i == 3)  // from the second on it is known that sums do without, and checks do not
      EXPECT_GE(bytes_per_node, 24.0) << i;
    else  // 7 nodes on a section in the mean
      EXPECT_LT(bytes_per_node, repels ? 4.5 : 1.0) << i;
    ASSERT_TRUE(is_same(made.whole_of(velocity_part), read(velocity))) << i;
    EXPECT_EQ(made.dynamics.find_fault(part), "");
    EXPECT_TRUE(is_same(made.whole_of(part), read(position))) << i;
    whole_vectors().combine(position, {{1.0, position}, {1e-5, velocity}});
    made.parts().combine(part, {{1.0, part}, {1e-5, velocity_part}});
  }
  EXPECT_NE(test::find_team()->partition().find("each rank has a part"), std::string::npos);
  EXPECT_GT(made.physics.mobility->error_record().n_checks, 1);
  EXPECT_EQ(made.physics.mobility->error_record().largest, alone.mobility->error_record().largest);
  made.dynamics.end_step();
  dynamics.end_step();
  made.dynamics.compute_velocity(0.1, position, velocity);  // of whole arrays
  const Nodes with_ranks = read(velocity);
  dynamics.compute_velocity(0.1, position, velocity);
  EXPECT_TRUE(is_same(with_ranks, read(velocity)));
}

INSTANTIATE_TEST_SUITE_P(, OwnedTreesInParts, ::testing::Bool(),
                         [](const auto& repels) { return std::string(repels.param ? "with_repulsion" : "alone"); });

/// The products of an implicit step's matrix.
TEST(OwnedNodes, HaveTheChangesOfVelocityOfOneProcessWhereTreesAreInParts) {
  const SceneConfig scene = make_scene(5500, SumMethod::fmm);
  Case made(scene);
  Physics alone = make_physics(scene);
  FiberDynamics dynamics(alone);
  const Nodes start = alone.make_start_nodes(1), moved = test::make_noise(made.n_nodes, 1);
  const Vectors position = to_device("position", start), displacement = to_device("displacement", moved);
  const Vectors change("change", start.size());
  const Vectors part = made.part_of(start), displacement_part = made.part_of(moved);
  const Vectors change_part = made.parts().make("change", made.n_nodes);
  Linearization &of_one = *dynamics.linearization(), &of_ranks = *made.dynamics.linearization();
  of_one.set_position(0.1, position);
  of_ranks.set_position(0.1, part);
  for (int i = 0; i < 3; ++i) {
    of_one.multiply(displacement, change);
    of_ranks.multiply(displacement_part, change_part);
    ASSERT_TRUE(is_same(made.whole_of(change_part), read(change))) << i;
    made.parts().copy(displacement_part, change_part);
    Kokkos::deep_copy(displacement, change);
  }
  EXPECT_GT(whole_vectors().root_mean_square(change), 0.0);
}

/// As sums are made on devices, which have an order of their own. @param team  null: one process
std::unique_ptr<Mobility> make_device_mobility(const SumMethod sums, const Precision precision, SumTeam* team) {
  if (sums == SumMethod::direct) return std::make_unique<DirectMobility>(1.0, precision, KernelPath::device, team);
  FmmOptions options;
  options.path = KernelPath::device;
  options.precision = precision;
  options.tolerance = 1e-3;
  options.leaf_size = 20;
  options.check_every = 7;
  return std::make_unique<FmmMobility>(1.0, options, team);
}

TEST(OwnedNodes, HaveTheVelocitiesOfOneProcessFromSumsOnDevices) {
  for (const SumMethod sums : {SumMethod::direct, SumMethod::fmm})
    for (const Precision precision : {Precision::in_double, Precision::in_single}) {
      const SceneConfig scene = make_scene(120);
      Case made(scene);
      Physics physics_of_one = make_physics(scene);
      FiberDynamics of_one(physics_of_one);
      made.physics.mobility = make_device_mobility(sums, precision, test::find_team());
      physics_of_one.mobility = make_device_mobility(sums, precision, nullptr);
      ASSERT_EQ(&made.dynamics.vectors(), made.physics.shared_nodes.get());
      const Nodes start = made.physics.make_start_nodes(1);
      const Vectors position = to_device("position", start), velocity("velocity", start.size());
      const Vectors part = made.part_of(start), velocity_part = made.parts().make("velocity", made.n_nodes);
      made.dynamics.begin_step();
      of_one.begin_step();
      for (int i = 0; i < 9; ++i) {
        of_one.compute_velocity(0.1, position, velocity);
        const Nodes expected = read(velocity);
        made.dynamics.compute_velocity(0.1, position, velocity);
        ASSERT_TRUE(is_same(read(velocity), expected)) << i << ", on rank 0";
        made.dynamics.compute_velocity(0.1, part, velocity_part);
        ASSERT_TRUE(is_same(made.whole_of(velocity_part), expected)) << i;
        whole_vectors().combine(position, {{1.0, position}, {1e-4, velocity}});
        made.parts().combine(part, {{1.0, part}, {1e-4, velocity_part}});
      }
      made.dynamics.end_step();
      of_one.end_step();
      EXPECT_EQ(made.physics.mobility->error_record().n_checks > 0, sums == SumMethod::fmm);
      EXPECT_EQ(made.physics.mobility->error_record().n_approximate > 0, sums == SumMethod::fmm);
    }
}

/// Each has a first step, in which it may keep its tree, and the second has the nodes a little farther on.
TEST(OwnedNodes, HaveSumsThatKnowNothingOfThoseBefore) {
  const SceneConfig scene = make_scene(120, SumMethod::fmm);
  Physics physics_of_one = make_physics(scene);
  const Nodes start = physics_of_one.make_start_nodes(1);
  const Vectors position = to_device("position", start), velocity("velocity", start.size());
  for (int k = 0; k < 4; ++k) {
    Case made(scene);
    Case one_process(scene);
    one_process.physics.mobility = make_physics(scene).mobility;
    for (Case* const with : {&one_process, &made}) {
      with->dynamics.begin_step();
      with->dynamics.compute_velocity(0.1, position, velocity);
      with->dynamics.end_step();
      if (with == &one_process) continue;
      const Vectors expected("expected", start.size());
      one_process.dynamics.compute_velocity(0.1, position, expected);
      ASSERT_TRUE(is_same(read(velocity), read(expected))) << k;
    }
    whole_vectors().combine(position, {{1.0, position}, {3e-4, velocity}});
  }
}

}  // namespace
}  // namespace skein
