// Forces that several ranks compute, each for its nodes, have the bits of those that one process computes.
#include <skein/physics/physics.hpp>

#include "src/physics/force_share.hpp"
#include "tests/support/force_rows.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <numeric>

namespace skein {
namespace {

constexpr double moment_of_test = 0.2;

/// One of several ranks, which are asked in turn: what others have is never there.
class RankInTurn final : public Communicator {
 public:
  RankInTurn(const int rank, const int size) : rank_(rank), size_(size) {}
  int rank() const override { return rank_; }
  int size() const override { return size_; }
  std::string describe() const override { return "a rank in turn"; }
  void broadcast(void*, std::size_t) override { FAIL(); }
  void gather(const double*, const RankParts&, double*) override { FAIL(); }
  void exchange(const double*, const RankParts&, double*, const RankParts&) override { FAIL(); }
  void gather_to_all(const std::vector<double*>& columns, const RankParts& parts) override {
    EXPECT_EQ(columns.size(), 3u);
    EXPECT_EQ(parts.count.size(), static_cast<std::size_t>(size_));
  }
  [[noreturn]] void fail(int, const std::string&) override { std::abort(); }

 private:
  int rank_, size_;
};

/// Fibers that are so bent and so near that every force acts.
SceneConfig make_scene(const test::ForceRow& row) {
  SceneConfig scene;
  FiberConfig thin, wide;
  thin.sections = 113;
  thin.nodes_per_section = 5;
  thin.reach_along = 3;
  wide.sections = 9;
  wide.nodes_per_section = 70;
  scene.fibers = {thin, wide, thin};
  row.configure(scene);
  return scene;
}

std::vector<Vec3> shake(std::vector<Vec3> nodes, const double size) {
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    nodes[i].x += size * std::sin(78.233 * static_cast<double>(i));
    nodes[i].y += size * std::sin(12.9898 * static_cast<double>(i));
  }
  return nodes;
}

bool is_same(const Vec3& a, const Vec3& b) { return std::memcmp(&a, &b, sizeof a) == 0; }

class ForceShareTest : public ::testing::TestWithParam<test::ForceRow> {
 protected:
  ForceShareTest() : scene_(make_scene(GetParam())), physics_(make_physics(scene_)) {
    const std::vector<Vec3> nodes = shake(make_surface_nodes(physics_.fibers), 1e-3);
    position_ = to_device("position", nodes);
    displacement_ = to_device("displacement", shake(std::vector<Vec3>(nodes.size(), Vec3{0.1, 0.2, 0.3}), 1.0));
  }

  /// From each of n ranks the forces on its nodes.
  std::vector<Vec3> share(const int n_ranks, const ConstVectors& displacement) const {
    std::vector<Vec3> all(position_.extent(0), Vec3{1e300, 1e300, 1e300});
    for (int rank = 0; rank < n_ranks; ++rank) {
      RankInTurn ranks(rank, n_ranks);
      const ForceShare share(scene_, n_ranks);  // as each rank makes it of the scene
      const Vectors force = to_device("force", std::vector<Vec3>(all.size(), Vec3{std::nan(""), -1.0, 3.0}));
      ForceShare::compute(ranks, share.nodes, share.forces, moment_of_test, position_, displacement, force);
      const std::vector<Vec3> there = to_host(ConstVectors(force));
      const auto first = static_cast<std::ptrdiff_t>(share.nodes.first[static_cast<std::size_t>(rank)]);
      const auto n = static_cast<std::ptrdiff_t>(share.nodes.count[static_cast<std::size_t>(rank)]);
      std::copy_n(there.begin() + first, n, all.begin() + first);
    }
    return all;
  }

  SceneConfig scene_;
  Physics physics_;
  Vectors position_, displacement_;
};

TEST_P(ForceShareTest, HasTheBitsOfOneProcess) {
  const Vectors force("force", position_.extent(0)), change("change", position_.extent(0));
  physics_.compute_forces(moment_of_test, position_, force);
  physics_.compute_force_changes(moment_of_test, position_, displacement_, change);
  const std::vector<Vec3> forces = to_host(ConstVectors(force)), changes = to_host(ConstVectors(change));
  for (const int n_ranks : {1, 2, 3, 60}) {
    const std::vector<Vec3> shared = share(n_ranks, {}), shared_changes = share(n_ranks, displacement_);
    for (std::size_t i = 0; i < forces.size(); ++i) {
      ASSERT_TRUE(is_same(shared[i], forces[i])) << "force on node " << i << " of " << n_ranks << " ranks";
      ASSERT_TRUE(is_same(shared_changes[i], changes[i])) << "change at node " << i << " of " << n_ranks << " ranks";
    }
  }
}

INSTANTIATE_TEST_SUITE_P(AllForces, ForceShareTest, ::testing::ValuesIn(test::force_rows),
                         [](const auto& row) { return std::string(row.param.name); });

TEST(ForceShareParts, AreWholeSectionsWithEvenSprings) {
  FiberConfig thin, wide;
  thin.sections = 60;
  thin.nodes_per_section = 4;
  wide.sections = 10;
  wide.nodes_per_section = 12;
  const std::vector<Fiber> fibers = make_fibers({thin, wide, thin});
  // Springs of a section with itself and its neighbours: 3 n^2. In all 3 (2 60 16 + 10 144) = 10080.
  for (const int n_ranks : {1, 2, 5, 8}) {
    const RankParts parts = share_nodes(fibers, n_ranks);
    EXPECT_EQ(parts.total(), 600u);
    ASSERT_EQ(parts.count.size(), static_cast<std::size_t>(n_ranks));
    for (std::size_t r = 0; r < parts.count.size(); ++r) {
      double springs = 0.0;
      for (std::size_t node = parts.first[r]; node < parts.first[r] + parts.count[r]; ++node)
        springs += 3.0 * (node < 240 || node >= 360 ? 4.0 : 12.0);
      EXPECT_NEAR(springs, 10080.0 / n_ranks, 432.0) << "rank " << r << " of " << n_ranks;
      const std::size_t edge = parts.first[r];
      EXPECT_EQ((edge < 240 ? edge : edge < 360 ? edge - 240 : edge - 360) % (edge < 240 || edge >= 360 ? 4 : 12), 0u);
    }
  }
  // More ranks than sections: some have none.
  const RankParts parts = share_nodes(make_fibers({wide}), 64);
  EXPECT_EQ(std::accumulate(parts.count.begin(), parts.count.end(), std::size_t{0}), 120u);
}

}  // namespace
}  // namespace skein
