// Which nodes' positions a rank needs for the forces on its own, and how it gets them.
#include <skein/physics/physics.hpp>

#include "src/physics/force_share.hpp"
#include "src/physics/node_parts.hpp"
#include "tests/reference/point_cloud.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>

namespace skein {
namespace {

using Nodes = std::vector<Vec3>;

/// Fibers of 4 sections of 5 nodes and 6 of 3: nodes 0 .. 19 and 20 .. 37.
SceneConfig make_scene() {
  SceneConfig scene;
  FiberConfig thick, thin;
  thick.sections = 4, thick.nodes_per_section = 5;
  thin.sections = 6, thin.nodes_per_section = 3, thin.center = {0.0, 0.1, 0.0};
  scene.fibers = {thick, thin};
  scene.flows.emplace_back().rate = 1.0;
  return scene;
}

NeededRows find(const SceneConfig& scene, std::vector<std::size_t> count) {
  const Physics physics = make_physics(scene);
  return find_needed_rows(physics.fibers, physics.forces, RankParts::behind_each_other(std::move(count)));
}

TEST(NeededRows, ReachAsFarAlongTheFiberAsForcesDo) {
  const NeededRows needed = find(make_scene(), {10, 5, 11, 0, 12});
  EXPECT_EQ(needed.first, (std::vector<std::size_t>{0, 5, 10, 26, 23}));
  EXPECT_EQ(needed.end, (std::vector<std::size_t>{15, 20, 29, 26, 38}));
}

TEST(NeededRows, EndWhereTheirFiberEnds) {
  const NeededRows needed = find(make_scene(), {20, 18});
  EXPECT_EQ(needed.first, (std::vector<std::size_t>{0, 20}));
  EXPECT_EQ(needed.end, (std::vector<std::size_t>{20, 38}));
}

TEST(NeededRows, FollowTheFarthestSpring) {
  SceneConfig scene = make_scene();
  scene.fibers[1].reach_along = 3;
  const NeededRows needed = find(scene, {10, 13, 15});
  EXPECT_EQ(needed.first, (std::vector<std::size_t>{0, 0, 20}));
  EXPECT_EQ(needed.end, (std::vector<std::size_t>{20, 32, 38}));
}

TEST(NeededRows, AreNoMoreWhereFibersRepelEachOtherByTheirCentroids) {
  SceneConfig scene = make_scene();
  const NeededRows alone = find(scene, {10, 16, 12});
  EXPECT_TRUE(alone.sections.count.empty());
  scene.repulsion.strength = 1.0;
  const NeededRows needed = find(scene, {10, 16, 12});
  EXPECT_EQ(needed.first, alone.first);
  EXPECT_EQ(needed.end, alone.end);
  EXPECT_EQ(needed.sections.count, (std::vector<std::size_t>{2, 4, 4}));
  EXPECT_EQ(find(scene, {0, 38, 0}).sections.count, (std::vector<std::size_t>{0, 10, 0}));
}

/// As one of one's own that promises nothing.
class FarReaching final : public Force {
 public:
  ForcePromises promises() const override { return {}; }
  void add_forces(double, const ConstVectors&, const Vectors&) const override {}
  void add_force_changes(double, const ConstVectors&, const ConstVectors&, const Vectors&) const override {}
  std::string describe() const override { return "far-reaching"; }
};

TEST(NeededRows, AreAllWhereAForceMayReachAnything) {
  Physics physics = make_physics(make_scene());
  physics.forces.push_back(std::make_unique<FarReaching>());
  EXPECT_TRUE(find_needed_rows(physics.fibers, physics.forces, RankParts::behind_each_other({20, 18})).are_all());
}

double component(const Vec3& v, const std::size_t c) { return c == 0 ? v.x : c == 1 ? v.y : v.z; }

/// One of several ranks, which has what the others would send, columns in the order x, y, z.
class ToldRank final : public Communicator {
 public:
  ToldRank(const int rank, const RankParts& owners, const NeededRows& needed, const Nodes& all)
      : rank_(rank), owners_(owners), needed_(needed), all_(all) {}
  int rank() const override { return rank_; }
  int size() const override { return static_cast<int>(owners_.count.size()); }
  std::string describe() const override { return "a rank that is told"; }
  void broadcast(void*, std::size_t) override { FAIL(); }
  void gather(const double*, const RankParts&, double*) override { FAIL(); }
  void gather_to_all(const std::vector<double*>&, const RankParts&) override { FAIL(); }
  void exchange(const double* send, const RankParts& sent, double* receive, const RankParts& received) override {
    const auto here = static_cast<std::size_t>(rank_);
    for (std::size_t other = 0; other < owners_.count.size(); ++other) {
      for (std::size_t i = sent.first[other]; i < sent.first[other] + sent.count[other]; ++i)
        EXPECT_EQ(send[i], component(all_[owners_.first[here] + i], column));
      for (std::size_t i = received.first[other]; i < received.first[other] + received.count[other]; ++i)
        receive[i] = component(all_[needed_.first[here] + i], column);
      n_sent.push_back(sent.count[other]);
      n_received.push_back(received.count[other]);
    }
    ++column;
  }
  [[noreturn]] void fail(int, const std::string&) override { std::abort(); }

  std::size_t column = 0;
  std::vector<std::size_t> n_sent, n_received;  ///< [3, n_ranks]

 private:
  int rank_;
  const RankParts& owners_;
  const NeededRows& needed_;
  const Nodes& all_;
};

class NeededRowsTest : public ::testing::TestWithParam<RowAccess> {};

TEST_P(NeededRowsTest, ComeFromTheirOwnersAndNothingElseDoes) {
  reference::Random random(3);
  const Nodes all = reference::make_random_vectors(38, 1.0, random);
  for (const std::vector<std::size_t>& count :
       {std::vector<std::size_t>{10, 5, 11, 0, 12}, {20, 18}, {5, 5, 5, 5, 3, 3, 3, 3, 3, 3}, {38, 0}, {0, 38}}) {
    const RankParts owners = RankParts::behind_each_other(count);
    SceneConfig scene = make_scene();
    scene.fibers[0].reach_along = 2;
    const NeededRows needed = find(scene, count);
    const std::size_t n_ranks = count.size();
    std::vector<std::vector<std::size_t>> n_sent, n_received;
    for (std::size_t rank = 0; rank < n_ranks; ++rank) {
      ToldRank told(static_cast<int>(rank), owners, needed, all);
      const Vectors part = make_part("part", owners, told.rank()), whole("whole", all.size());
      const std::size_t first = owners.first[rank], end = first + owners.count[rank];
      const Nodes own(all.begin() + static_cast<std::ptrdiff_t>(first), all.begin() + static_cast<std::ptrdiff_t>(end));
      if (!own.empty()) Kokkos::deep_copy(part, to_device("own", own));
      Kokkos::deep_copy(whole, 77.0);
      gather_needed_rows(told, owners, needed, part, whole, GetParam());
      const Nodes got = to_host(ConstVectors(whole));
      for (std::size_t i = 0; i < all.size(); ++i)
        EXPECT_EQ(got[i], i >= needed.first[rank] && i < needed.end[rank] ? all[i] : (Vec3{77.0, 77.0, 77.0}))
            << "row " << i << " on rank " << rank << " of " << n_ranks;
      n_sent.push_back(told.n_sent);
      n_received.push_back(told.n_received);
    }
    for (std::size_t a = 0; a < n_ranks; ++a)
      for (std::size_t b = 0; b < n_ranks; ++b) EXPECT_EQ(n_sent[a][b], n_received[b][a]) << a << " to " << b;
  }
}

INSTANTIATE_TEST_SUITE_P(, NeededRowsTest, ::testing::Values(RowAccess::as_needed, RowAccess::by_copies),
                         [](const auto& access) { return std::string(access.index == 0 ? "as_needed" : "by_copies"); });

}  // namespace
}  // namespace skein
