#include <skein/core/error.hpp>
#include <skein/physics/direct_mobility.hpp>
#include <skein/physics/fmm_mobility.hpp>

#include "fmm/tree_fit.hpp"
#include "tests/accuracy/fmm_cases.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <iterator>
#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

// Random configurations by the thousand: every sum is within its tolerance, or is refused.

namespace skein {
namespace {

using reference::Cloud;
using reference::PointForces;
using reference::Random;

constexpr double tolerances[] = {1e-2, 1e-3, 3e-4, 1e-4, 1e-5, 3e-6, 1e-6, 1e-7, 1e-8, 1e-9, 1e-10};
constexpr int leaf_sizes[] = {0, 12, 40};

const char* const force_kinds[] = {"random", "aligned", "without sum", "opposed in pairs"};

struct Configuration {
  PointForces from;
  std::vector<Vec3> target;  ///< empty: the sources' own array
  double tolerance = 0.0;
  int leaf_size = 0;
  bool is_kept = false;  ///< by a tree of nodes that have moved by its margin since
  int force_kind = 0;
};

std::vector<Vec3> make_nodes(Random& random) {
  const int n = static_cast<int>(random.log_uniform(100.0, 4000.0));
  const int shape = static_cast<int>(random.uniform(0.0, 6.0));
  if (shape == 4) return make_spiral(math::larger(1, n / 18));
  if (shape == 5) return make_tube(math::larger(1, n / 18));
  std::vector<Vec3> nodes = reference::make_cloud(reference::all_clouds[shape], n, random.in_cube(2.0), 1.0, random);
  if (random.uniform(0.0, 1.0) < 0.1)  // some twice in one place
    nodes.insert(nodes.end(), nodes.begin(), nodes.begin() + n / 3);
  return nodes;
}

/// Root mean square distance from the middle.
double extent_of(const std::vector<Vec3>& nodes) {
  Vec3 middle{0.0, 0.0, 0.0};
  for (const Vec3& x : nodes) middle = middle + x / static_cast<double>(nodes.size());
  double sum = 0.0;
  for (const Vec3& x : nodes) sum += dot(x - middle, x - middle) / static_cast<double>(nodes.size());
  return std::sqrt(sum);
}

Configuration make_configuration(Random& random) {
  Configuration made;
  made.from.position = make_nodes(random);
  const int n = static_cast<int>(made.from.position.size());
  auto& force = made.from.force;
  force = reference::make_random_vectors(n, 1.0, random);
  made.force_kind = static_cast<int>(random.uniform(0.0, 4.0));
  Vec3 mean{0.0, 0.0, 0.0};
  for (const Vec3& f : force) mean = mean + f / static_cast<double>(n);
  for (int i = 0; i < n; ++i) {
    Vec3& f = force[static_cast<std::size_t>(i)];
    if (made.force_kind == 1) f = f + Vec3{3.0, 0.0, 1.0};
    if (made.force_kind == 2) f = f - mean;
    if (made.force_kind == 3 && i % 2 == 1) f = -0.999 * force[static_cast<std::size_t>(i) - 1];
  }
  const double extent = extent_of(made.from.position);
  const double blob = extent / std::cbrt(n) * random.log_uniform(1e-3, 0.5);
  made.from.blob = random.uniform(0.0, 1.0) < 0.4 ? reference::make_random_lengths(n, 0.01 * blob, blob, random)
                                                  : std::vector<double>(static_cast<std::size_t>(n), blob);
  made.tolerance = tolerances[static_cast<int>(random.uniform(0.0, std::size(tolerances)))];
  made.leaf_size = leaf_sizes[static_cast<int>(random.uniform(0.0, std::size(leaf_sizes)))];
  const double use = random.uniform(0.0, 1.0);
  made.is_kept = use < 0.25;
  if (use > 0.7) {
    const Vec3 beside = made.from.position.front() + random.in_cube(extent);
    made.target = reference::make_cloud(reference::all_clouds[static_cast<int>(random.uniform(0.0, 4.0))], 300, beside,
                                        1.5 * extent, random);
  }
  return made;
}

/// Every coordinate by +- distance.
void move(std::vector<Vec3>& nodes, const double distance, Random& random) {
  const auto side = [&] { return random.bits() % 2 ? distance : -distance; };
  for (Vec3& x : nodes) x = x + Vec3{side(), side(), side()};
}

/// Operators are kept for the tolerances and leaves that there are.
class Sums {
 public:
  FmmMobility& of(const Configuration& made) {
    auto& fmm = kept_[{made.tolerance, made.leaf_size}];
    if (fmm == nullptr) {
      FmmOptions options;
      options.tolerance = made.tolerance;
      options.leaf_size = made.leaf_size;
      fmm = std::make_unique<FmmMobility>(viscosity, options);
    }
    return *fmm;
  }

 private:
  std::map<std::pair<double, int>, std::unique_ptr<FmmMobility>> kept_;
};

/// Error over tolerance. @throws Error where the sum is refused
double measure(Configuration& made, FmmMobility& fmm, Random& random) {
  const std::size_t n_targets = made.target.empty() ? made.from.position.size() : made.target.size();
  const Vectors velocity("velocity", n_targets), exact("exact", n_targets);
  if (made.is_kept) {
    const Sources first = on_device(made.from);
    fmm.begin_step();
    fmm.add_velocity(first, first.position, velocity);
    move(made.from.position, 0.999 * leaf_margin * fmm.statistics().smallest_half_width, random);
    Kokkos::deep_copy(velocity, 0.0);
  }
  const Sources sources = on_device(made.from);
  const ConstVectors at = made.target.empty() ? sources.position : ConstVectors(to_device("target", made.target));
  fmm.add_velocity(sources, at, velocity);
  fmm.end_step();
  DirectMobility(viscosity, Precision::in_double).add_velocity(sources, at, exact);
  return error_of(to_host(velocity), to_host(exact)) / made.tolerance;
}

void expect_all_within(const int n_cases, const std::uint64_t seed) {
  Random random(seed);
  Sums sums;
  int n_refused = 0, n_far = 0, n_tails = 0, n_kept = 0, n_apart = 0, n_mixed = 0;
  double worst[4] = {};
  for (int k = 0; k < n_cases; ++k) {
    Configuration made = make_configuration(random);
    FmmMobility& fmm = sums.of(made);
    try {
      const double error = measure(made, fmm, random);
      EXPECT_LE(error, 1.0) << "case " << k << ": " << made.from.position.size() << " nodes, tolerance "
                            << made.tolerance << ", forces " << force_kinds[made.force_kind]
                            << (made.target.empty() ? "" : ", targets apart") << (made.is_kept ? ", kept tree" : "")
                            << ", tail of degree " << fmm.statistics().plan.tail_degree;
      worst[made.force_kind] = std::fmax(worst[made.force_kind], error);
      n_far += fmm.statistics().work.far_pairs > 0.0;
      n_tails += fmm.statistics().plan.tail_degree > 0;
      n_kept += made.is_kept;
      n_apart += !made.target.empty();
      n_mixed += made.from.blob.front() != made.from.blob.back();
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), ExitCode::scene_error) << error.what();
      fmm.end_step();
      ++n_refused;
    }
  }
  std::printf(
      "%d configurations: %d refused, %d with a far field, %d with tails, %d by a kept tree at its margin, "
      "%d with targets apart, %d with many blobs; worst error over tolerance:",
      n_cases, n_refused, n_far, n_tails, n_kept, n_apart, n_mixed);
  for (int kind = 0; kind < 4; ++kind) std::printf(" %.2f (forces %s)", worst[kind], force_kinds[kind]);
  std::printf("\n");
  EXPECT_GT(n_far, n_cases / 2);
  EXPECT_GT(n_tails, n_cases / 50);
  EXPECT_GT(n_kept, n_cases / 8);
  EXPECT_GT(n_apart, n_cases / 8);
  EXPECT_LT(n_refused, n_cases / 10);
}

TEST(ManySums, AreWithinTheirTolerancesOrRefused) { expect_all_within(40, 11); }
TEST(ManySumsSlow, AreWithinTheirTolerancesOrRefused) { expect_all_within(2000, 2027); }

}  // namespace
}  // namespace skein
