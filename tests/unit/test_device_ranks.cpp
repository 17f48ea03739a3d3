#include "tests/unit/device_ranks.hpp"

#include <memory>

// Ranks that share a sum by teams, each with its part of the leaves, have the bits of one process.

namespace skein {
namespace {

using test::are_same;
using test::Cloud;
using test::compute;
using test::make_options;
using test::Post;
using test::Problem;
using test::RankInTurn;
using test::Teams;

/// Sums of one process and of ranks, which keep their trees and arrays.
class Shared {
 public:
  Shared(const int n_ranks, const std::size_t most_product_bytes)
      : alone_(TeamWorkers(usual_team_size<ExecSpace>, most_product_bytes)) {
    for (int rank = 0; rank < n_ranks; ++rank) {
      ranks_.push_back(std::make_unique<RankInTurn>(rank, n_ranks, post_));
      sums_.push_back(
          std::make_unique<Teams>(TeamWorkers(usual_team_size<ExecSpace>, most_product_bytes), ranks_.back().get()));
    }
  }

  void expect_same_bits(const Problem& problem, const FmmOptions& options) {
    const std::vector<Vec3> expected = compute(alone_, problem, options, problem.n_targets());
    EXPECT_GT(alone_.statistics.work.far_pairs, 0.0);
    post_.clear();
    for (std::size_t rank = sums_.size(); rank-- > 0;) {
      sums_[rank]->owners = {};
      const std::vector<Vec3> got = compute(*sums_[rank], problem, options, problem.n_targets());
      if (rank > 0) continue;
      EXPECT_TRUE(are_same(got, expected.data())) << sums_.size() << " ranks, all on rank 0";
    }
    // Owners that no tree knows of, one of them of nothing where there are several.
    const auto n_targets = static_cast<std::size_t>(problem.n_targets());
    std::vector<std::size_t> counts(sums_.size(), 0);
    counts.back() = n_targets / 3;
    counts.front() += n_targets - counts.back();
    const RankParts owners = RankParts::behind_each_other(counts);
    post_.clear();
    for (int round = 0; round < 2; ++round)
      for (std::size_t rank = 0; rank < sums_.size(); ++rank) {
        sums_[rank]->owners = owners;
        const std::vector<Vec3> got = compute(*sums_[rank], problem, options, static_cast<int>(owners.count[rank]));
        if (round == 0) continue;
        EXPECT_TRUE(are_same(got, expected.data() + owners.first[rank])) << "delivered to rank " << rank;
      }
  }
  void begin_step() {
    alone_.begin_step();
    for (const auto& sum : sums_) sum->begin_step();
  }
  std::int64_t n_trees() const { return sums_.back()->statistics.n_trees; }
  const FmmStatistics& statistics() const { return sums_.front()->statistics; }

 private:
  Post post_;
  Teams alone_;
  std::vector<std::unique_ptr<RankInTurn>> ranks_;
  std::vector<std::unique_ptr<Teams>> sums_;
};

constexpr std::size_t much = std::size_t{1} << 29;

TEST(DeviceRanks, HaveTheBitsOfOneProcess) {
  for (const int n_ranks : {1, 2, 3, 5}) {
    Shared shared(n_ranks, much);
    for (const Precision precision : {Precision::in_double, Precision::in_single})
      for (const Cloud cloud : {Cloud::cube, Cloud::cluster, Cloud::tube})
        for (const bool apart : {false, true}) {
          if (n_ranks != 3 && cloud != Cloud::cube) continue;  // for less time
          SCOPED_TRACE(reference::name_of(cloud) + (apart ? ", targets apart" : "") +
                       (precision == Precision::in_single ? ", single" : ""));
          shared.expect_same_bits(Problem(cloud, 600, apart, 1e-4, 1e-3), make_options(precision));
        }
  }
}

TEST(DeviceRanks, HaveTheBitsThroughEveryKindOfList) {
  FmmOptions options = make_options(Precision::in_double);
  options.leaf_size = 40;
  const Problem problem = Problem::uneven();
  Octree<ExecSpace> tree;
  tree.build(ExecSpace(), problem.position, problem.position,
             make_octree_rules(options, choose_fmm_plan(options, 1e-4, 0)));
  EXPECT_GT(tree.v_list.n_entries, 0);
  EXPECT_GT(tree.w_list.n_entries, 0);
  EXPECT_GT(tree.x_list.n_entries, 0);
  Shared(2, much).expect_same_bits(problem, options);
}

// Far pairs go through room for a few of them in one process, so that sums have an order that ranks have to keep.
TEST(DeviceRanks, TakeFarPairsInTheRunsOfOneProcess) {
  for (const int n_ranks : {2, 3}) {
    Shared in_long_runs(n_ranks, 1'000'000), one_by_one(n_ranks, 1);
    in_long_runs.expect_same_bits(Problem(Cloud::cube, 2000, false, 1e-4, 1e-3), make_options(Precision::in_double));
    EXPECT_GT(in_long_runs.statistics().work.far_pairs, 2000.0);
    one_by_one.expect_same_bits(Problem(Cloud::cluster, 300, false, 1e-4, 1e-3), make_options(Precision::in_double));
  }
}

// An order of sums that followed from the memory of sums before would differ between a run and one that goes on from
// it.
TEST(DeviceRanks, RunsOfFarPairsDoNotDependOnWhatWasBefore) {
  const FmmOptions options = make_options(Precision::in_double);
  FmmOptions of_higher_order = options;
  of_higher_order.order = 6;
  const Problem problem(Cloud::cube, 1500, false, 1e-4, 1e-3);
  for (const std::size_t bytes : {std::size_t{1'000'000}, std::size_t{2'000'000}}) {
    const TeamWorkers workers(usual_team_size<ExecSpace>, bytes);
    Teams fresh(workers), used(workers);
    compute(used, problem, of_higher_order, problem.n_targets());
    const std::vector<Vec3> expected = compute(fresh, problem, options, problem.n_targets());
    EXPECT_TRUE(are_same(compute(used, problem, options, problem.n_targets()), expected.data())) << bytes;
  }
}

TEST(DeviceRanks, HaveTheBitsWithTheBlobsNextTerm) {
  FmmOptions options = make_options(Precision::in_double);
  options.order = 6;
  options.tail_degree = 4;
  Shared shared(3, much);
  for (const bool apart : {false, true}) shared.expect_same_bits(Problem(Cloud::cube, 700, apart, 2e-3, 2e-3), options);
  EXPECT_EQ(shared.statistics().plan.tail_degree, 4);
}

TEST(DeviceRanks, KeepTreesAndTheirShares) {
  FmmOptions options = make_options(Precision::in_double);
  for (const FarField far_field : {FarField::harmonic, FarField::stokeslet}) {
    options.far_field = far_field;
    Shared shared(far_field == FarField::harmonic ? 3 : 2, much);
    const Problem problem(Cloud::cube, 700, false, 1e-4, 1e-3);
    shared.begin_step();
    for (int sum = 0; sum < 3; ++sum) {
      shared.expect_same_bits(problem, options);
      problem.move(1e-5);
    }
    EXPECT_EQ(shared.n_trees(), 1);
    shared.begin_step();
    problem.move(0.3);
    shared.expect_same_bits(problem, options);
    EXPECT_GT(shared.n_trees(), 1);
  }
}

}  // namespace
}  // namespace skein
