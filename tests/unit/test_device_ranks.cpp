#include "fmm/fmm_evaluator.hpp"
#include "fmm/team_sum.hpp"
#include "tests/reference/point_cloud.hpp"
#include "tests/reference/regularized_stokeslet_reference.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <map>
#include <memory>

// Ranks that share a sum by teams, each with its part of the leaves, have the bits of one process. They are asked in
// turn, because none needs more of another than its velocities.

namespace skein {

extern template class FmmEvaluator<TeamWorkers>;

namespace {

using reference::Cloud;
using reference::PointForces;
using reference::Random;

constexpr double viscosity = 0.7;

/// What ranks send, until it is asked for.
using Post = std::map<std::pair<int, int>, std::vector<double>>;

/// One of several ranks, which are asked in turn, those that receive twice: what is not there yet is no number.
class RankInTurn final : public Communicator {
 public:
  RankInTurn(const int rank, const int size, Post& post) : rank_(rank), size_(size), post_(post) {}
  int rank() const override { return rank_; }
  int size() const override { return size_; }
  std::string describe() const override { return "a rank in turn"; }
  void broadcast(void*, std::size_t) override { FAIL(); }
  void gather_to_all(const std::vector<double*>&, const RankParts&) override { FAIL(); }
  void gather(const double* own, const RankParts& parts, double* all) override {
    const auto here = static_cast<std::size_t>(rank_);
    post_[{rank_, 0}].assign(own, own + parts.count[here]);
    for (int other = 0; rank_ == 0 && other < size_; ++other)
      deliver(other, 0, parts.count[static_cast<std::size_t>(other)],
              all + parts.first[static_cast<std::size_t>(other)]);
  }
  void exchange(const double* send, const RankParts& sent, double* receive, const RankParts& received) override {
    for (int other = 0; other < size_; ++other) {
      const auto r = static_cast<std::size_t>(other);
      post_[{rank_, other}].assign(send + sent.first[r], send + sent.first[r] + sent.count[r]);
      deliver(other, rank_, received.count[r], receive + received.first[r]);
    }
  }
  [[noreturn]] void fail(int, const std::string&) override { std::abort(); }

 private:
  void deliver(const int from, const int to, const std::size_t n, double* numbers) const {
    const auto found = post_.find({from, to});
    if (found == post_.end()) return void(std::fill_n(numbers, n, std::nan("")));
    ASSERT_EQ(found->second.size(), n) << from << " to " << to;
    std::copy(found->second.begin(), found->second.end(), numbers);
  }

  int rank_, size_;
  Post& post_;
};

using Teams = FmmEvaluator<TeamWorkers>;

/// Nodes, and targets of their own or apart.
struct Problem {
  Vectors position, force, target;
  Scalars blob;

  Problem(const Cloud cloud, const int n, const bool apart, const double low_blob, const double high_blob) {
    Random random(21);
    position = to_device("position", reference::make_cloud(cloud, n, {0.4, -3.0, 0.2}, 0.8, random));
    force = to_device("force", reference::make_random_vectors(n, 1.3, random));
    blob = to_device("blob", reference::make_random_lengths(n, low_blob, high_blob, random));
    target = apart ? to_device("target", reference::make_cloud(Cloud::cube, n / 2, {0.5, -3.1, 0.2}, 0.6, random))
                   : position;
  }
  /// Crowded in one place of a cube, so that there are lists of every kind.
  static Problem uneven() {
    Problem made(Cloud::cluster, 2250, false, 1e-4, 1e-4);
    std::vector<Vec3> nodes = to_host(ConstVectors(made.position));
    Random random(5);
    const std::vector<Vec3> even = reference::make_cloud(Cloud::cube, 750, {0.4, -3.0, 0.2}, 0.8, random);
    std::copy(even.begin(), even.end(), nodes.begin() + 1500);
    Kokkos::deep_copy(made.position, to_device("uneven", nodes));
    return made;
  }
  int n_targets() const { return target.extent_int(0); }
  void move(const double by) const {
    std::vector<Vec3> nodes = to_host(ConstVectors(position));
    for (std::size_t i = 0; i < nodes.size(); ++i) nodes[i].x += by * std::sin(78.233 * static_cast<double>(i));
    Kokkos::deep_copy(position, to_device("moved", nodes));
  }
};

/// What a rank has in the end: all velocities, or those of the targets that it owns.
std::vector<Vec3> compute(Teams& sum, const Problem& problem, const FmmOptions& options, const int n_there) {
  EXPECT_TRUE(sum.take({problem.position, problem.force, problem.blob}, problem.target));
  EXPECT_TRUE(sum.compute(options, choose_fmm_plan(options, sum.largest_blob(), 0), viscosity));
  const Vectors velocity("velocity", static_cast<std::size_t>(n_there));
  sum.add_to(velocity);
  return to_host(ConstVectors(velocity));
}

bool are_same(const std::vector<Vec3>& a, const Vec3* b) {
  return std::memcmp(a.data(), b, a.size() * sizeof(Vec3)) == 0;
}

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

FmmOptions make_options(const Precision precision) {
  FmmOptions options;
  options.path = KernelPath::device;
  options.order = 4;
  options.tolerance = 1.0;
  options.precision = precision;
  options.leaf_size = 12;
  options.min_half_width = 0.004;
  return options;
}

TEST(DeviceRanks, HaveTheBitsOfOneProcess) {
  for (const int n_ranks : {1, 2, 3, 5}) {
    Shared shared(n_ranks, much);
    for (const Precision precision : {Precision::in_double, Precision::in_single})
      for (const Cloud cloud : {Cloud::cube, Cloud::cluster, Cloud::tube})
        for (const bool apart : {false, true}) {
          SCOPED_TRACE(reference::name_of(cloud) + (apart ? ", targets apart" : "") +
                       (precision == Precision::in_single ? ", single" : ""));
          shared.expect_same_bits(Problem(cloud, 700, apart, 1e-4, 1e-3), make_options(precision));
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
  for (const FarField far_field : {FarField::harmonic, FarField::stokeslet}) {
    options.far_field = far_field;
    for (const int n_ranks : {2, 3}) Shared(n_ranks, much).expect_same_bits(problem, options);
  }
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
  for (const std::size_t bytes : {std::size_t{1'000'000}, std::size_t{2'000'000}, std::size_t{3'000'000}}) {
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
  for (const int n_ranks : {2, 3}) {
    Shared shared(n_ranks, much);
    for (const bool apart : {false, true})
      shared.expect_same_bits(Problem(Cloud::cube, 700, apart, 2e-3, 2e-3), options);
    EXPECT_EQ(shared.statistics().plan.tail_degree, 4);
  }
}

TEST(DeviceRanks, KeepTreesAndTheirShares) {
  for (const int n_ranks : {2, 3}) {
    Shared shared(n_ranks, much);
    const Problem problem(Cloud::cube, 700, false, 1e-4, 1e-3);
    shared.begin_step();
    for (int sum = 0; sum < 3; ++sum) {
      shared.expect_same_bits(problem, make_options(Precision::in_double));
      problem.move(1e-5);
    }
    EXPECT_EQ(shared.n_trees(), 1);
    shared.begin_step();
    problem.move(0.3);
    shared.expect_same_bits(problem, make_options(Precision::in_double));
    EXPECT_GT(shared.n_trees(), 1);
  }
}

/// Near and far pairs of the leaves and boxes of a rank, as a host counts them.
double count_work(const HostOctree& tree, const FmmPlan& plan, const IndexRange own) {
  FmmWork work;
  for (int leaf = 0; leaf < tree.n_target_leaves; ++leaf)
    if (overlap(tree.target_leaf(leaf).targets, own))
      for (const IndexRange& run : tree.near_runs(leaf))
        work.near_pairs += 1.0 * run.count * tree.target_leaf(leaf).targets.count;
  for (int b = 0; b < tree.n_boxes(); ++b)
    if (overlap(tree.box(b).targets, own)) work.far_pairs += static_cast<double>(tree.v_list.of(b).size());
  return estimate_nanoseconds(work, plan, false, KernelPath::device);
}

TEST(DeviceRanks, DivideTheWorkOfManyLeavesEvenly) {
  FmmOptions options = make_options(Precision::in_double);
  options.leaf_size = 30;  // so that near pairs are most of the work, far more of them where nodes are crowded
  const FmmPlan plan = choose_fmm_plan(options, 1e-4, 0);
  const OctreeRules rules = make_octree_rules(options, plan);
  for (const Problem& problem : {Problem::uneven(), Problem(Cloud::tube, 6000, false, 1e-4, 1e-4)}) {
    Octree<ExecSpace> tree;
    tree.build(ExecSpace(), problem.position, problem.position, rules);
    HostOctree on_host;
    const auto nodes = Kokkos::create_mirror_view_and_copy(Kokkos::HostSpace(), problem.position);
    on_host.build(HostSpace(), nodes, nodes, rules);
    for (const int n_ranks : {1, 2, 3, 64}) {
      int next = 0;
      double all = 0.0, most = 0.0;
      for (int rank = 0; rank < n_ranks; ++rank) {
        const RankShares shares = share_targets(tree, plan, rank, n_ranks);
        EXPECT_EQ(shares.own_targets().first, next);
        next += shares.own_targets().count;
        const double work = count_work(on_host, plan, shares.own_targets());
        all += work;
        most = std::max(most, work);
      }
      EXPECT_EQ(next, tree.n_targets);
      EXPECT_LT(most * n_ranks / all, n_ranks < 10 ? 1.2 : 4.0) << n_ranks;
    }
  }
}

}  // namespace
}  // namespace skein
