// What ranks do with their parts of arrays has the bits of what rank 0 does with whole ones.
#include <skein/dynamics/make_integrator.hpp>
#include <skein/solvers/right_hand_side_decorator.hpp>

#include "tests/property/owned_nodes_case.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <map>

namespace skein {
namespace {

using test::Case;
using test::is_same;
using test::make_noise;
using test::make_scene;
using test::Nodes;
using test::read;

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
      EXPECT_TRUE(is_same(made.parts().dot_product(part[0], part[1]), whole_vectors().dot_product(whole[0], whole[1])))
          << what << ", " << sections;
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
    made.parts().set_to_zero(part[3]);
    EXPECT_EQ(made.parts().dot_product(part[3], part[3]), 0.0);
    EXPECT_TRUE(is_same(made.whole_of(part[3]), Nodes(static_cast<std::size_t>(made.n_nodes), Vec3{})));
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
  Case made(scene()), other(scene());
  WholeDynamics whole_dynamics(other.dynamics);
  const auto parts = make_integrator(scene(), made.physics, made.dynamics);
  const auto whole = make_integrator(scene(), other.physics, whole_dynamics);
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

INSTANTIATE_TEST_SUITE_P(Methods, OwnedSteps,
                         ::testing::Values(TimeMethod::rkc2, TimeMethod::trbdf2, TimeMethod::bs3, TimeMethod::rk4,
                                           TimeMethod::euler));

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
  // Of the last one trees are in parts, so that ranks do not have all positions.
  for (const auto& [sections, sums] :
       {std::pair{120, SumMethod::direct}, std::pair{120, SumMethod::fmm}, std::pair{5500, SumMethod::fmm}}) {
    Case made(make_scene(sections, sums));
    Nodes nodes = made.physics.make_start_nodes(1);
    const Vectors part = made.part_of(nodes), velocity = made.parts().make("velocity", made.n_nodes);
    made.dynamics.compute_velocity(0.0, part, velocity);
    EXPECT_EQ(made.dynamics.find_fault(part), "");
    nodes.back().y = std::nan("");
    made.parts().scatter(to_device("nodes", nodes), part);
    made.dynamics.compute_velocity(0.0, part, velocity);
    EXPECT_TRUE(std::isnan(made.parts().root_mean_square(velocity)));
    EXPECT_NE(made.dynamics.find_fault(part).find("node " + std::to_string(made.n_nodes - 1)), std::string::npos);
    made.dynamics.seek_fault(part);
    EXPECT_NE(made.dynamics.find_fault(part), "");
  }
}

}  // namespace
}  // namespace skein
