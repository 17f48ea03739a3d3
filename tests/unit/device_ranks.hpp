#pragma once

#include "fmm/fmm_evaluator.hpp"
#include "fmm/team_sum.hpp"
#include "tests/reference/point_cloud.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <map>
#include <string>
#include <utility>
#include <vector>

// Sums by teams that ranks share, in one process: the ranks are asked in turn, because none needs more of another than
// its velocities.

namespace skein {

extern template class FmmEvaluator<TeamWorkers>;

namespace test {

using reference::Cloud;
using reference::Random;

inline constexpr double viscosity = 0.7;

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
inline std::vector<Vec3> compute(Teams& sum, const Problem& problem, const FmmOptions& options, const int n_there) {
  EXPECT_TRUE(sum.take({problem.position, problem.force, problem.blob}, problem.target));
  EXPECT_TRUE(sum.compute(options, choose_fmm_plan(options, sum.largest_blob(), 0), viscosity));
  const Vectors velocity("velocity", static_cast<std::size_t>(n_there));
  sum.add_to(velocity);
  return to_host(ConstVectors(velocity));
}

inline bool are_same(const std::vector<Vec3>& a, const Vec3* b) {
  return std::memcmp(a.data(), b, a.size() * sizeof(Vec3)) == 0;
}

inline FmmOptions make_options(const Precision precision) {
  FmmOptions options;
  options.path = KernelPath::device;
  options.order = 4;
  options.tolerance = 1.0;
  options.precision = precision;
  options.leaf_size = 12;
  options.min_half_width = 0.004;
  return options;
}

}  // namespace test
}  // namespace skein
