#include <skein/core/error.hpp>
#include <skein/physics/fmm_mobility.hpp>

#include "fmm/fmm_choices.hpp"
#include "fmm/octree.hpp"
#include "tests/accuracy/fmm_cases.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

// The blobs' term of eps^4, carried between boxes by polynomials: against sums in long double, on hosts and in the
// memory of a device.

namespace skein {
namespace {

using reference::Cloud;
using reference::PointForces;
using reference::Random;

struct Result {
  std::vector<Vec3> velocity;
  FmmStatistics statistics;
};

/// @param target  empty: the sources' own array
Result evaluate(const PointForces& from, const std::vector<Vec3>& target, const FmmOptions& options) {
  const Sources sources = on_device(from);
  const ConstVectors at = target.empty() ? sources.position : ConstVectors(to_device("target", target));
  const Vectors velocity("velocity", at.extent(0));
  FmmMobility fmm(viscosity, options);
  fmm.add_velocity(sources, at, velocity);
  return {to_host(velocity), fmm.statistics()};
}

double error_of(const Result& result, const PointForces& from, const std::vector<Vec3>& target) {
  const auto& at = target.empty() ? from.position : target;
  return error_of(result.velocity, reference::compute_stokeslet_velocity(from, at, viscosity));
}

class BlobTail : public testing::TestWithParam<KernelPath> {
 protected:
  /// Nothing but the blobs makes an error that counts.
  FmmOptions options(const int tail_degree) const {
    FmmOptions options;
    options.tolerance = 1.0;
    options.order = 12;
    options.singular_cutoff = 1e-13;
    options.precision = Precision::in_double;
    options.leaf_size = 30;
    options.tail_degree = tail_degree;
    options.path = GetParam();
    return options;
  }
};

/// Error between the nearest well-separated boxes.
double nearest_boxes_error(FmmOptions options, const double blob_over_half_width, const std::uint64_t seed) {
  const NearestBoxes boxes(blob_over_half_width, seed);
  options.leaf_size = 1;
  options.min_half_width = boxes.half_width;
  const Result result = evaluate(boxes.from, boxes.target, options);
  EXPECT_EQ(result.statistics.work.near_pairs, 0.0);
  EXPECT_EQ(result.statistics.work.far_pairs, 1.0);
  return error_of(result, boxes.from, boxes.target);
}

TEST_P(BlobTail, LeavesAFloorOfTheSixthPower) {
  for (const double ratio : {0.1, 0.2, 0.4}) {
    const double got = nearest_boxes_error(options(8), ratio, 5), floor = harmonic_floor(ratio, 1.0, 8);
    EXPECT_LT(got, floor) << ratio;
    EXPECT_GT(got, 0.1 * floor) << ratio;
    EXPECT_LT(got, 0.03 * nearest_boxes_error(options(FmmOptions::no_tail), ratio, 5)) << ratio;
  }
}

TEST_P(BlobTail, FallsWithTheDegreeAsTheLawSays) {
  double before = nearest_boxes_error(options(FmmOptions::no_tail), 0.06, 6);
  for (int degree = 1; degree <= 8; ++degree) {
    const double got = nearest_boxes_error(options(degree), 0.06, 6), floor = harmonic_floor(0.06, 1.0, degree);
    EXPECT_LT(got, floor) << degree;
    EXPECT_GT(got, 0.1 * floor) << degree;
    EXPECT_LT(got, before) << degree;
    before = got;
  }
}

/// A cloud with a cluster in it: leaves of many sizes.
PointForces make_uneven(const double low_blob, const double high_blob) {
  Random random(21);
  PointForces from;
  from.position = reference::make_cloud(Cloud::cluster, 3000, {0.4, -3.0, 0.2}, 0.5, random);
  const auto even = reference::make_cloud(Cloud::cube, 1500, {0.4, -3.0, 0.2}, 0.8, random);
  from.position.insert(from.position.end(), even.begin(), even.end());
  const int n = static_cast<int>(from.position.size());
  from.force = reference::make_random_vectors(n, 1.3, random);
  for (Vec3& f : from.force) f = f + Vec3{0.4, 0.1, 0.0};
  from.blob = reference::make_random_lengths(n, low_blob, high_blob, random);
  return from;
}

// The blobs' error of what is summed pair by pair or left out would be the same with polynomials and without.
TEST_P(BlobTail, PassesThroughEveryKindOfList) {
  const double half_width = 0.02;
  FmmOptions with = options(8), without = options(FmmOptions::no_tail);
  for (FmmOptions* o : {&with, &without}) {
    o->order = 8;  // so that boxes have sources enough for the lists W and X
    o->singular_cutoff = 1e-11;
    o->min_half_width = half_width;
  }
  PointForces from = make_uneven(0.7 * half_width, 1.0 * half_width);
  from.force.assign(from.force.size(), {1.0, 0.3, -0.2});
  const ConstVectors nodes = to_device("nodes", from.position);
  const ConstVectorView<HostSpace> on_host = Kokkos::create_mirror_view_and_copy(Kokkos::HostSpace(), nodes);
  HostOctree tree;
  tree.build(HostSpace(), on_host, on_host, make_octree_rules(with, choose_fmm_plan(with, half_width, 0)));
  EXPECT_GT(tree.v_list.n_entries, 0);
  EXPECT_GT(tree.w_list.n_entries, 0);
  EXPECT_GT(tree.x_list.n_entries, 0);
  Random random(4);
  const auto apart = reference::make_cloud(Cloud::cluster, 1500, {0.45, -3.0, 0.22}, 0.6, random);
  for (const std::vector<Vec3>& target : {std::vector<Vec3>(), apart}) {
    const Result result = evaluate(from, target, with);
    EXPECT_EQ(result.statistics.plan.tail_degree, 8);
    const auto exact = reference::compute_stokeslet_velocity(from, target.empty() ? from.position : target, viscosity);
    EXPECT_LT(error_of(result.velocity, exact), 0.1 * error_of(evaluate(from, target, without).velocity, exact));
  }
}

TEST_P(BlobTail, IsTheSameOnBothPaths) {
  FmmOptions with = options(5);
  with.order = 6;
  with.singular_cutoff = 0.0;
  with.min_half_width = 0.02;
  const PointForces from = make_uneven(1e-3, 6e-3);
  FmmOptions on_host = with;
  on_host.path = KernelPath::host;
  EXPECT_LT(error_of(evaluate(from, {}, with).velocity, evaluate(from, {}, on_host).velocity), 1e-12);
  with.precision = Precision::in_single;
  on_host = with;
  on_host.path = KernelPath::host;
  EXPECT_LT(error_of(evaluate(from, {}, with).velocity, evaluate(from, {}, on_host).velocity), 1e-5);
}

TEST_P(BlobTail, IsTakenWhereItPaysAndNowhereElse) {
  FmmOptions automatic;
  automatic.path = GetParam();
  automatic.tolerance = 1e-7;
  const PointForces coil = with_forces(make_spiral(500), fiber_blob, 3);
  const Result result = evaluate(coil, {}, automatic);
  EXPECT_GT(result.statistics.plan.tail_degree, 0);
  EXPECT_LE(result.statistics.plan.blob_error, automatic.tolerance);
  EXPECT_LT(error_of(result, coil, {}), automatic.tolerance);
  FmmOptions plain = automatic;
  plain.tail_degree = FmmOptions::no_tail;
  EXPECT_LT(result.statistics.work.near_pairs, 0.5 * evaluate(coil, {}, plain).statistics.work.near_pairs);
  EXPECT_EQ(evaluate(with_forces(make_spiral(500), 1e-5, 3), {}, automatic).statistics.plan.tail_degree, 0);
  automatic.tolerance = 1e-3;
  EXPECT_EQ(evaluate(coil, {}, automatic).statistics.plan.tail_degree, 0);
}

TEST_P(BlobTail, RefusesLeavesThatAreTooSmallForTheDegree) {
  const PointForces from = with_forces(make_tube(100), fiber_blob, 3);
  FmmOptions small;
  small.path = GetParam();
  small.tolerance = 1e-6;
  small.min_half_width = 3.0 * fiber_blob;
  EXPECT_THROW(evaluate(from, {}, small), Error);
  small.min_half_width = 6.0 * fiber_blob;
  EXPECT_NO_THROW(evaluate(from, {}, small));
  small.tail_degree = 2;
  EXPECT_THROW(evaluate(from, {}, small), Error);
  small.tail_degree = 9;
  EXPECT_THROW(evaluate(from, {}, small), Error);
}

INSTANTIATE_TEST_SUITE_P(Paths, BlobTail, testing::Values(KernelPath::host, KernelPath::device),
                         [](const auto& path) { return path.param == KernelPath::host ? "host" : "device"; });

}  // namespace
}  // namespace skein
