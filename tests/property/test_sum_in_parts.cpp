// A fast multipole sum over nodes of which each rank has some has the bits of the sum of one process, which every rank
// computes for itself here. All ranks run the tests.
#include <skein/arrays/runtime.hpp>
#include <skein/fmm/fmm_sum.hpp>

#include "mpi/launch.hpp"
#include "tests/reference/point_cloud.hpp"
#include "tests/unit/stokeslet_case.hpp"

#include <gtest/gtest.h>

#include <cstring>
#include <iterator>
#include <limits>
#include <memory>
#include <string>
#include <vector>

namespace skein {
namespace {

using reference::Cloud;
using Nodes = std::vector<Vec3>;

Communicator* all_ranks = nullptr;

constexpr int n_trials = 40;

struct Problem {
  Nodes position, force;
  std::vector<double> blob;
  int n() const { return static_cast<int>(position.size()); }
};

Problem make_problem(const Cloud cloud, const int n, const bool has_blobs) {
  reference::Random random(7 + static_cast<std::uint64_t>(n));
  Problem problem;
  problem.position = make_cloud(cloud, n, {0.3, -0.2, 5.0}, 1.0, random);
  problem.force = make_random_vectors(n, 1.0, random);
  problem.blob =
      has_blobs ? make_random_lengths(n, 1e-4, 4e-3, random) : std::vector<double>(static_cast<std::size_t>(n), 2e-3);
  return problem;
}

/// Of n nodes some for each rank: uneven, and none for the second of three.
RankParts make_parts(const int n) {
  const auto n_ranks = static_cast<std::size_t>(all_ranks->size());
  std::vector<std::size_t> count(n_ranks);
  std::size_t left = static_cast<std::size_t>(n);
  for (std::size_t r = 0; r + 1 < n_ranks; ++r) {
    count[r] = r == 1 ? 0 : left / 3;
    left -= count[r];
  }
  count.back() = left;
  return RankParts::behind_each_other(std::move(count));
}

template <class Entry>
std::vector<Entry> rows_of(const std::vector<Entry>& all, const RankParts& parts) {
  const auto rank = static_cast<std::size_t>(all_ranks->rank());
  const auto first = all.begin() + static_cast<std::ptrdiff_t>(parts.first[rank]);
  return {first, first + static_cast<std::ptrdiff_t>(parts.count[rank])};
}

struct OnDevice {
  Vectors position, force;
  Scalars blob;
  OnDevice(const Nodes& x, const Nodes& f, const std::vector<double>& eps)
      : position(to_device("position", x)), force(to_device("force", f)), blob(to_device("blob", eps)) {}
  Sources sources() const { return {position, force, blob}; }
};

struct Sums {
  std::unique_ptr<FmmSum> whole = make_fmm_sum(KernelPath::host), part = make_fmm_sum(KernelPath::host, all_ranks);

  void begin_step() {
    whole->begin_step();
    part->begin_step();
  }
  void end_step() {
    whole->end_step();
    part->end_step();
  }

  /// Computes both, and compares this rank's rows.
  void compare(const Problem& problem, const FmmOptions& options, const std::string& what) {
    const OnDevice all(problem.position, problem.force, problem.blob);
    ASSERT_TRUE(whole->take(all.sources(), all.position));
    const FmmPlan plan = choose_fmm_plan(options, whole->largest_blob(), 0);
    ASSERT_TRUE(whole->compute(options, plan, 1.3));
    const Vectors sum("sum", problem.position.size());
    whole->add_to(sum);
    const Nodes wanted = to_host(ConstVectors(sum));

    const RankParts parts = make_parts(problem.n());
    const OnDevice own(rows_of(problem.position, parts), rows_of(problem.force, parts), rows_of(problem.blob, parts));
    part->owners = parts;
    ASSERT_TRUE(part->take_part(own.sources(), parts));
    EXPECT_EQ(part->largest_blob(), whole->largest_blob());
    ASSERT_TRUE(part->compute(options, plan, 1.3));
    const Vectors own_sum("own", own.position.extent(0));
    part->add_to(own_sum);
    const Nodes got = to_host(ConstVectors(own_sum)), mine = rows_of(wanted, parts);
    std::size_t n_other = 0;
    for (std::size_t i = 0; i < mine.size(); ++i) n_other += std::memcmp(&got[i], &mine[i], sizeof(Vec3)) == 0 ? 0 : 1;
    EXPECT_EQ(n_other, 0u) << what << ": of " << mine.size() << " on rank " << all_ranks->rank();

    const FmmStatistics &a = whole->statistics, &b = part->statistics;
    EXPECT_EQ(a.n_boxes, b.n_boxes) << what;
    EXPECT_EQ(a.n_leaves, b.n_leaves) << what;
    EXPECT_EQ(a.n_levels, b.n_levels) << what;
    EXPECT_EQ(a.n_trees, b.n_trees) << what;
    EXPECT_EQ(a.work.near_pairs, b.work.near_pairs) << what;
    EXPECT_EQ(a.work.far_pairs, b.work.far_pairs) << what;
    EXPECT_EQ(a.plan.near_in_single, b.plan.near_in_single) << what;
    EXPECT_EQ(a.plan.tail_degree, b.plan.tail_degree) << what;
  }
};

FmmOptions make_options(const double tolerance) {
  FmmOptions options;
  options.tolerance = tolerance;
  return options;
}

TEST(Ranks, AddUpAndListWhatEachHas) {
  const int n_ranks = all_ranks->size(), rank = all_ranks->rank();
  for (const int n : {0, 1, 3, 40}) {
    std::vector<double> numbers;
    for (int i = 0; i < n; ++i) numbers.push_back(100.0 * i + rank);
    const std::vector<double> listed = list_from_all(*all_ranks, numbers);
    ASSERT_EQ(listed.size(), static_cast<std::size_t>(n * n_ranks));
    for (int r = 0; r < n_ranks; ++r)
      for (int i = 0; i < n; ++i) EXPECT_EQ(listed[static_cast<std::size_t>(r * n + i)], 100.0 * i + r);
    add_up_to_all(*all_ranks, numbers);
    for (int i = 0; i < n; ++i)
      EXPECT_EQ(numbers[static_cast<std::size_t>(i)], 100.0 * i * n_ranks + n_ranks * (n_ranks - 1) / 2);
  }
}

TEST(SumInParts, HasTheBitsOfTheWhole) {
  for (const double tolerance : {1e-3, 1e-6, 1e-9}) {
    Sums sums;
    for (const Cloud cloud : reference::all_clouds)
      for (const int n : {1, 2, 3, 50, 700, 6000})
        sums.compare(make_problem(cloud, n, false), make_options(tolerance),
                     name_of(cloud) + ", " + std::to_string(n) + " nodes, " + std::to_string(tolerance));
  }
}

TEST(SumInParts, HasThemWithBlobsOfManySizes) {
  for (const Cloud cloud : reference::all_clouds)
    for (const int n : {50, 6000})
      Sums().compare(make_problem(cloud, n, true), make_options(1e-4), name_of(cloud) + ", " + std::to_string(n));
}

TEST(SumInParts, HasThemWithEveryFarField) {
  for (const FarField field : {FarField::harmonic, FarField::stokeslet, FarField::regularized})
    for (const int leaf_size : {3, 60}) {
      FmmOptions options = make_options(1e-2);
      options.far_field = field;
      options.leaf_size = leaf_size;
      Sums().compare(make_problem(Cloud::cluster, 2000, false), options, "leaves of " + std::to_string(leaf_size));
    }
}

TEST(SumInParts, HasThemForAnyNodes) {
  reference::Random random(23);
  constexpr double tolerances[] = {1e-2, 1e-4, 1e-5, 1e-7};
  Sums sums[std::size(tolerances)];  // operators are what takes longest
  for (int trial = 0; trial < n_trials; ++trial) {
    const Cloud cloud = reference::all_clouds[random.bits() % 4];
    const int n = static_cast<int>(random.log_uniform(1.0, 4000.0));
    const std::size_t k = random.bits() % std::size(tolerances);
    FmmOptions options = make_options(tolerances[k]);
    options.leaf_size = static_cast<int>(random.log_uniform(2.0, 200.0));
    sums[k].compare(make_problem(cloud, n, random.bits() % 4 == 0), options,
                    "trial " + std::to_string(trial) + ": " + name_of(cloud) + ", " + std::to_string(n) +
                        " nodes, leaves of " + std::to_string(options.leaf_size) + ", " +
                        std::to_string(options.tolerance));
  }
}

TEST(SumInParts, KeepsATreeWhereTheWholeDoes) {
  for (const Cloud cloud : reference::all_clouds) {
    Sums sums;
    Problem problem = make_problem(cloud, 4000, false);
    for (int step = 0; step < 2; ++step) {
      sums.begin_step();
      for (int evaluation = 0; evaluation < 4; ++evaluation) {
        sums.compare(problem, make_options(1e-4), name_of(cloud) + ", moved");
        // The last time by enough for a new tree, of one node of the last rank.
        for (std::size_t i = 0; i < problem.position.size(); ++i) problem.position[i].x += 1e-7 * problem.force[i].y;
        if (evaluation == 2) problem.position.back().z += 0.5;
        for (Vec3& f : problem.force) f = 1.01 * f;
      }
      sums.end_step();
    }
    EXPECT_LT(sums.part->statistics.n_trees, 8);
    EXPECT_GT(sums.part->statistics.n_trees, 1);
  }
}

TEST(SumInParts, IsOneTreeAfterAnotherOfOtherNodes) {
  Sums sums;
  for (const int n : {3000, 40, 9000, 700})
    for (const Cloud cloud : {Cloud::tube, Cloud::cube})
      sums.compare(make_problem(cloud, n, false), make_options(1e-5), name_of(cloud) + ", " + std::to_string(n));
}

TEST(SumInParts, ComesToRankZeroWhereNobodyOwnsIt) {
  const Problem problem = make_problem(Cloud::tube, 3000, false);
  const RankParts parts = make_parts(problem.n());
  const OnDevice all(problem.position, problem.force, problem.blob);
  const OnDevice own(rows_of(problem.position, parts), rows_of(problem.force, parts), rows_of(problem.blob, parts));
  Sums sums;
  const FmmOptions options = make_options(1e-5);
  ASSERT_TRUE(sums.whole->take(all.sources(), all.position));
  ASSERT_TRUE(sums.part->take_part(own.sources(), parts));
  const FmmPlan plan = choose_fmm_plan(options, 2e-3, 0);
  ASSERT_TRUE(sums.whole->compute(options, plan, 1.0));
  ASSERT_TRUE(sums.part->compute(options, plan, 1.0));
  if (all_ranks->rank() != 0) return;
  const Vectors one("one", problem.position.size()), other("other", problem.position.size());
  sums.whole->add_to(one);
  sums.part->add_to(other);
  const Nodes wanted = to_host(ConstVectors(one)), got = to_host(ConstVectors(other));
  EXPECT_EQ(std::memcmp(wanted.data(), got.data(), wanted.size() * sizeof(Vec3)), 0);
  const EvenSample sample(problem.n(), 20);
  const Nodes a = sums.whole->sample(sample), b = sums.part->sample(sample);
  EXPECT_EQ(std::memcmp(a.data(), b.data(), a.size() * sizeof(Vec3)), 0);
}

TEST(SumInParts, SaysWhereAPositionIsNone) {
  const RankParts parts = make_parts(100);
  Problem problem = make_problem(Cloud::cube, 100, false);
  problem.position.back().y = std::numeric_limits<double>::infinity();  // the last rank's
  const OnDevice own(rows_of(problem.position, parts), rows_of(problem.force, parts), rows_of(problem.blob, parts));
  Sums sums;
  EXPECT_FALSE(sums.part->take_part(own.sources(), parts));
}

}  // namespace
}  // namespace skein

int main(int argc, char** argv) {
  ::testing::InitGoogleTest(&argc, argv);
  skein::all_ranks = skein::join_ranks();
  if (skein::all_ranks == nullptr) return 64;
  const auto run = [] {
    const skein::Runtime runtime;
    return RUN_ALL_TESTS();
  };
  return skein::leave_ranks(run());
}
