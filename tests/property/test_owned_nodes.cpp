// What ranks do with their parts of arrays has the bits of what rank 0 does with whole ones.
#include <skein/dynamics/fiber_dynamics.hpp>
#include <skein/dynamics/make_integrator.hpp>
#include <skein/physics/direct_mobility.hpp>
#include <skein/physics/fmm_mobility.hpp>
#include <skein/physics/shared_nodes.hpp>
#include <skein/physics/sum_team.hpp>
#include <skein/solvers/right_hand_side_decorator.hpp>

#include "tests/support/rank_team.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <map>
#include <random>

namespace skein {
namespace {

using Nodes = std::vector<Vec3>;

Nodes make_noise(const int n, const unsigned seed) {
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  Nodes nodes(static_cast<std::size_t>(n));
  for (Vec3& v : nodes) v = {uniform(random), uniform(random), uniform(random)};
  return nodes;
}

bool is_same(const Nodes& a, const Nodes& b) {
  return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(Vec3)) == 0;
}
bool is_same(const double a, const double b) { return std::memcmp(&a, &b, sizeof a) == 0; }

Nodes read(const ConstVectors& vectors) { return to_host(vectors); }

/// Sections of 9 and 5 nodes, so that no edge between ranks is one of a chunk of a dot product.
SceneConfig make_scene(const int sections, const SumMethod sums = SumMethod::direct) {
  SceneConfig scene;
  FiberConfig thick, thin;
  thick.sections = thin.sections = sections;
  thick.nodes_per_section = 9;
  thin.nodes_per_section = 5;
  thick.start_amplitude = thin.start_amplitude = 0.02;
  thick.direction = {1.0, 0.4, 0.1};
  thin.direction = {1.0, 0.5, 0.0};
  thin.center = {0.0, 0.0, 0.03};
  thick.blob = thin.blob = 0.0045;
  scene.fibers = {thick, thin};
  scene.flows.emplace_back().rate = 2.5;
  scene.hydrodynamics.method = sums;
  scene.hydrodynamics.tolerance = 1e-3;
  scene.hydrodynamics.check_every = 7;
  return scene;
}

/// Physics that ranks share, and arrays of both kinds.
struct Case {
  Physics physics;
  FiberDynamics dynamics{physics};
  int n_nodes = count_nodes(physics.fibers);

  explicit Case(const SceneConfig& scene) : physics(make_physics(scene, test::find_team())) {}
  NodeVectors& parts() { return *physics.shared_nodes; }
  Vectors part_of(const Nodes& nodes) {
    const Vectors part = parts().make("part", n_nodes);
    parts().scatter(to_device("whole", nodes), part);
    return part;
  }
  Nodes whole_of(const Vectors& part) { return read(parts().gather(part)); }
};

/// Numbers of nodes on both sides of chunks of 256, and fewer sections than ranks.
constexpr int section_counts[] = {2, 3, 18, 19, 37, 120};

TEST(OwnedNodes, ArePartsOfAllNodes) {
  for (const int sections : section_counts) {
    Case made(make_scene(sections));
    const Nodes nodes = make_noise(made.n_nodes, 1);
    const Vectors part = made.part_of(nodes);
    EXPECT_TRUE(made.physics.shared_nodes->have_made(part));
    EXPECT_FALSE(made.physics.shared_nodes->have_made(to_device("whole", nodes)));
    EXPECT_LT(part.extent_int(0), made.n_nodes);
    // Once from what rank 0 has sent, and once from the others, whose parts are changed to the same.
    EXPECT_TRUE(is_same(made.whole_of(part), nodes));
    made.parts().combine(part, {{1.0, part}, {0.0, part}});
    EXPECT_TRUE(is_same(made.whole_of(part), nodes)) << sections;
  }
}

TEST(OwnedNodes, AreCombinedAndMeasuredAsWholeArraysAre) {
  for (const int sections : section_counts) {
    Case made(make_scene(sections));
    std::vector<Vectors> part, whole;
    for (unsigned i = 0; i < 5; ++i) {
      const Nodes nodes = make_noise(made.n_nodes, i + 1);
      part.push_back(made.part_of(nodes));
      whole.push_back(to_device("whole", nodes));
    }
    const auto compare = [&](const char* what) {
      EXPECT_TRUE(is_same(made.whole_of(part[0]), read(whole[0]))) << what;
      const double of_parts = made.parts().root_mean_square(part[0]);
      EXPECT_TRUE(is_same(of_parts, whole_vectors().root_mean_square(whole[0]))) << what << ", " << sections;
      EXPECT_GT(of_parts, 0.1);
    };
    compare("as they were");
    const auto combine = [&](NodeVectors& nodes, const std::vector<Vectors>& v) {
      nodes.combine(v[0], {{0.3, v[0]}, {-1.1, v[1]}});
      nodes.combine(v[1], {{0.7, v[0]}, {0.9, v[2]}, {1.7, v[3]}, {-0.2, v[4]}});
      nodes.copy(v[2], v[1]);
      nodes.combine(v[0], {{0.1, v[4]}, {0.2, v[3]}, {0.4, v[2]}, {0.8, v[1]}, {1.6, v[0]}});
    };
    // More work than goes with one order.
    for (int i = 0; i < 4; ++i) {
      combine(made.parts(), part);
      combine(whole_vectors(), whole);
    }
    compare("combined");
  }
}

TEST(OwnedNodes, AreKnownOnRankZeroAfterACopy) {
  Case made(make_scene(19));
  const Nodes nodes = make_noise(made.n_nodes, 3), others = make_noise(made.n_nodes, 4);
  const Vectors part = made.part_of(nodes), copy = made.parts().make_like("copy", part);
  const Communicator& ranks = test::find_team()->ranks();
  made.parts().copy(copy, part);
  const double messages = ranks.traffic().messages;
  EXPECT_TRUE(is_same(made.whole_of(copy), nodes));
  EXPECT_EQ(ranks.traffic().messages, messages) << "what is saved when a rank is lost is not asked of it";
  // What one of them becomes is nothing to the other.
  made.parts().scatter(to_device("others", others), part);
  EXPECT_TRUE(is_same(made.whole_of(copy), nodes));
  EXPECT_TRUE(is_same(made.whole_of(part), others));
}

TEST(OwnedNodes, GiveBackWhatNobodyUses) {
  Case made(make_scene(19));
  const Nodes nodes = make_noise(made.n_nodes, 5);
  const Vectors kept = made.part_of(nodes);
  for (unsigned i = 0; i < 30; ++i) made.part_of(make_noise(made.n_nodes, i));
  EXPECT_TRUE(is_same(made.whole_of(kept), nodes));
}

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
TEST(OwnedNodes, HaveTheVelocitiesOfOneProcessWhereTreesAreInParts) {
  SceneConfig scene = make_scene(5500, SumMethod::fmm);
  scene.hydrodynamics.check_every = 2;
  Case made(scene);
  Physics alone = make_physics(scene);
  FiberDynamics dynamics(alone);
  const Nodes start = alone.make_start_nodes(1);
  const Vectors position = to_device("position", start), velocity("velocity", start.size());
  const Vectors part = made.part_of(start), velocity_part = made.parts().make("velocity", made.n_nodes);
  for (RightHandSide* const each :
       {static_cast<RightHandSide*>(&dynamics), static_cast<RightHandSide*>(&made.dynamics)})
    each->begin_step();
  for (int i = 0; i < 3; ++i) {
    dynamics.compute_velocity(0.1, position, velocity);
    made.dynamics.compute_velocity(0.1, part, velocity_part);
    ASSERT_TRUE(is_same(made.whole_of(velocity_part), read(velocity))) << i;
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

/// Integrators that work with whole arrays, as those of one process.
class WholeDynamics final : public RightHandSideDecorator {
 public:
  explicit WholeDynamics(RightHandSide& dynamics) : RightHandSideDecorator(dynamics) {}
  NodeVectors& vectors() override { return whole_vectors(); }
};

/// Counts evaluations, and throws at one.
class ThrowingDynamics final : public RightHandSideDecorator {
 public:
  explicit ThrowingDynamics(RightHandSide& dynamics) : RightHandSideDecorator(dynamics) {}
  void compute_velocity(const double time, const ConstVectors& position, const Vectors& velocity) override {
    if (--left == 0) throw std::runtime_error("asked for");
    inner_.compute_velocity(time, position, velocity);
  }
  int left = -1;
};

/// What a checkpoint holds.
class Memory final : public MemoryVisitor {
 public:
  explicit Memory(const bool restores) : restores_(restores) {}
  void restore() { restores_ = true; }
  void number(const std::string_view name, double& value) override { keep(numbers_, name, value); }
  void integer(const std::string_view name, std::int64_t& value) override { keep(integers_, name, value); }
  void vectors(const std::string_view name, const Vectors& values) override {
    Nodes& there = vectors_[std::string(name)];
    if (restores_)
      Kokkos::deep_copy(values, to_device("there", there));
    else
      there = read(values);
  }
  bool changes_what_it_sees() const override { return restores_; }
  bool is_same(const Memory& other) const {
    bool same = numbers_ == other.numbers_ && integers_ == other.integers_ && vectors_.size() == other.vectors_.size();
    for (const auto& [name, nodes] : vectors_) same = same && skein::is_same(nodes, other.vectors_.at(name));
    return same;
  }
  std::size_t n_vectors() const { return vectors_.size(); }

 private:
  template <class Value>
  void keep(std::map<std::string, Value>& all, const std::string_view name, Value& value) {
    if (restores_)
      value = all.at(std::string(name));
    else
      all[std::string(name)] = value;
  }
  bool restores_;
  std::map<std::string, double> numbers_;
  std::map<std::string, std::int64_t> integers_;
  std::map<std::string, Nodes> vectors_;
};

class OwnedSteps : public ::testing::TestWithParam<TimeMethod> {
 protected:
  static SceneConfig scene() {
    SceneConfig scene = make_scene(20);
    scene.time.method = GetParam();
    scene.time.end = 1.0;
    if (GetParam() == TimeMethod::euler) scene.time.step = 1e-4;
    return scene;
  }
  static Memory remember(Integrator& integrator) {
    Memory memory(false);
    integrator.visit_memory(memory);
    return memory;
  }
};

TEST_P(OwnedSteps, HaveTheBitsOfOneProcess) {
  Case made(scene());
  WholeDynamics whole_dynamics(made.dynamics);
  const auto parts = make_integrator(scene(), made.physics, made.dynamics);
  const auto whole = make_integrator(scene(), made.physics, whole_dynamics);
  const Nodes start = made.physics.make_start_nodes(1);
  State a{0.0, 0, to_device("a", start)}, b{0.0, 0, to_device("b", start)};
  const Vectors at_a("at_a", start.size()), at_b("at_b", start.size());
  for (int step = 0; step < 30; ++step) {
    const double before = a.time;
    const StepReport of_parts = parts->advance(a, 1.0), of_whole = whole->advance(b, 1.0);
    ASSERT_TRUE(is_same(of_parts.error, of_whole.error) && is_same(a.time, b.time)) << step;
    ASSERT_TRUE(is_same(of_parts.spectral_radius, of_whole.spectral_radius)) << step;
    ASSERT_TRUE(is_same(read(a.position), read(b.position))) << step;
    parts->interpolate(0.3 * before + 0.7 * a.time, at_a);
    whole->interpolate(0.3 * before + 0.7 * a.time, at_b);
    ASSERT_TRUE(is_same(read(at_a), read(at_b))) << step;
    ASSERT_TRUE(remember(*parts).is_same(remember(*whole))) << step;
  }
  EXPECT_FALSE(is_same(read(a.position), start));
}

/// Rank 0 then has all that a checkpoint takes, without asking.
TEST_P(OwnedSteps, ThatAreGivenUpLeaveWhatWas) {
  Case made(scene());
  ThrowingDynamics throwing(made.dynamics);
  const auto integrator = make_integrator(scene(), made.physics, throwing);
  const Communicator& ranks = test::find_team()->ranks();
  State state{0.0, 0, to_device("state", made.physics.make_start_nodes(1))};
  for (int step = 0; step < 3; ++step) integrator->advance(state, 1.0);
  const Memory before = remember(*integrator);
  const Nodes position = read(state.position);
  throwing.left = GetParam() == TimeMethod::euler ? 1 : 2;
  EXPECT_THROW(integrator->advance(state, 1.0), std::runtime_error);
  const double messages = ranks.traffic().messages;
  EXPECT_TRUE(remember(*integrator).is_same(before));
  EXPECT_EQ(ranks.traffic().messages, messages);
  EXPECT_TRUE(is_same(read(state.position), position));

  // It goes on as one that was never given up, and so does one that is made anew.
  State again{state.time, state.step, to_device("again", position)};
  const auto other = make_integrator(scene(), made.physics, made.dynamics);
  Memory memory = before;
  memory.restore();
  other->visit_memory(memory);
  EXPECT_TRUE(remember(*other).is_same(before));
  for (int step = 0; step < 3; ++step) {
    integrator->advance(state, 1.0);
    other->advance(again, 1.0);
    ASSERT_TRUE(is_same(read(state.position), read(again.position))) << step;
  }
}

INSTANTIATE_TEST_SUITE_P(Explicit, OwnedSteps,
                         ::testing::Values(TimeMethod::rkc2, TimeMethod::bs3, TimeMethod::rk4, TimeMethod::euler));

TEST(OwnedNodes, AreNotTakenWherePhysicsIsNotTheScenes) {
  Case made(make_scene(19));
  EXPECT_EQ(&made.dynamics.vectors(), made.physics.shared_nodes.get());
  made.physics.forces.pop_back();
  EXPECT_EQ(&made.dynamics.vectors(), &whole_vectors());
  Case other(make_scene(19));
  other.physics.mobility = make_physics(make_scene(19)).mobility;
  EXPECT_EQ(&other.dynamics.vectors(), &whole_vectors()) << "a mobility of one process";
}

TEST(OwnedNodes, WithoutNumbersAreAllAtFault) {
  for (const SumMethod sums : {SumMethod::direct, SumMethod::fmm}) {
    Case made(make_scene(120, sums));
    Nodes nodes = made.physics.make_start_nodes(1);
    nodes.back().y = std::nan("");
    const Vectors part = made.part_of(nodes), velocity = made.parts().make("velocity", made.n_nodes);
    made.dynamics.compute_velocity(0.0, part, velocity);
    EXPECT_TRUE(std::isnan(made.parts().root_mean_square(velocity)));
    EXPECT_NE(made.dynamics.find_fault(part).find("node " + std::to_string(made.n_nodes - 1)), std::string::npos);
    made.dynamics.seek_fault(part);
    EXPECT_NE(made.dynamics.find_fault(part), "");
  }
}

}  // namespace
}  // namespace skein
