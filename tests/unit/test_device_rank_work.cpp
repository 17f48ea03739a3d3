#include "tests/unit/device_ranks.hpp"

#include <cstdint>

// What ranks do that share a sum by teams, and what one process does not.

namespace skein {
namespace {

using test::Cloud;
using test::make_options;
using test::Post;
using test::Problem;
using test::RankInTurn;
using test::Teams;
using test::viscosity;

/// Launches by name, and waits for numbers.
std::map<std::string, int> launches;
int n_reductions = 0, n_copies = 0;

void note_kernel(const char* name, std::uint32_t, std::uint64_t*) { ++launches[name]; }
void note_reduction(const char*, std::uint32_t, std::uint64_t*) { ++n_reductions; }
void note_copy(Kokkos::Tools::SpaceHandle, const char*, const void*, Kokkos::Tools::SpaceHandle, const char*,
               const void*, std::uint64_t) {
  ++n_copies;
}

/// What one sum launches. @param ranks  null: one process  @param is_kept  the second of a step, else the first of all
std::map<std::string, int> count_launches(Communicator* ranks, const bool is_kept) {
  const Problem problem(Cloud::cube, 700, false, 1e-4, 1e-3);
  const FmmOptions options = make_options(Precision::in_double);
  Teams sum(TeamWorkers(), ranks);
  sum.begin_step();
  const auto compute_sum = [&] {
    sum.take({problem.position, problem.force, problem.blob}, problem.target);
    sum.compute(options, choose_fmm_plan(options, sum.largest_blob(), 0), viscosity);
  };
  if (is_kept) compute_sum();
  launches.clear();
  n_reductions = n_copies = 0;
  Kokkos::Tools::Experimental::set_begin_parallel_for_callback(note_kernel);
  Kokkos::Tools::Experimental::set_begin_parallel_scan_callback(note_kernel);
  Kokkos::Tools::Experimental::set_begin_parallel_reduce_callback(note_reduction);
  Kokkos::Tools::Experimental::set_begin_deep_copy_callback(note_copy);
  compute_sum();
  Kokkos::Tools::Experimental::set_begin_parallel_for_callback(nullptr);
  Kokkos::Tools::Experimental::set_begin_parallel_scan_callback(nullptr);
  Kokkos::Tools::Experimental::set_begin_parallel_reduce_callback(nullptr);
  Kokkos::Tools::Experimental::set_begin_deep_copy_callback(nullptr);
  return launches;
}

// One process does nothing that only ranks need, and a rank with a kept tree sends velocities and nothing else.
TEST(DeviceRanks, LaunchNothingMoreInOneProcess) {
  Post post;
  RankInTurn ranks(1, 2, post);
  for (const bool is_kept : {false, true}) {
    const auto of_one = count_launches(nullptr, is_kept);
    const int reductions_of_one = n_reductions, copies_of_one = n_copies;
    auto of_ranks = count_launches(&ranks, is_kept);
    EXPECT_EQ(n_reductions, reductions_of_one);
    for (const char* const name :
         {"skein::mark_own_far_pairs", "skein::keep_own_far_pairs", "skein::count_near_pairs", "skein::pack_vectors"}) {
      EXPECT_EQ(of_one.count(name), 0u) << name;
      EXPECT_EQ(of_ranks.count(name), is_kept && std::string(name) != "skein::pack_vectors" ? 0u : 1u) << name;
    }
    EXPECT_GT(of_one.size(), 5u) << "the tool is not asked";
    EXPECT_LE(copies_of_one, n_copies);
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
