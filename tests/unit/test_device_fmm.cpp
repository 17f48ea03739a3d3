#include <skein/core/error.hpp>
#include <skein/physics/fmm_mobility.hpp>

#include "fmm/fmm_evaluator.hpp"
#include "fmm/team_sum.hpp"
#include "tests/reference/point_cloud.hpp"
#include "tests/reference/regularized_stokeslet_reference.hpp"
#include "tests/support/nan_trap.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <limits>

// The path through a device, in the execution space, against the host's path and against long double sums.

namespace skein {

extern template class FmmEvaluator<TeamWorkers>;

namespace {

using reference::Cloud;
using reference::PointForces;
using reference::Random;
using reference::relative_error;

constexpr double viscosity = 0.7;

Sources on_device(const PointForces& from) {
  return {to_device("position", from.position), to_device("force", from.force), to_device("blob", from.blob)};
}

PointForces make_forces(const Cloud cloud, const int n, const double low_blob, const double high_blob) {
  Random random(21);
  return {reference::make_cloud(cloud, n, {0.4, -3.0, 0.2}, 0.8, random),
          reference::make_random_vectors(n, 1.3, random),
          reference::make_random_lengths(n, low_blob, high_blob, random)};
}

FmmOptions options_for(const FarField far_field) {
  FmmOptions options;
  options.far_field = far_field;
  options.path = KernelPath::device;
  options.order = far_field == FarField::harmonic ? 6 : 4;
  options.tolerance = far_field == FarField::harmonic ? 1e-3 : 1.0;
  options.precision = Precision::in_double;
  options.leaf_size = 12;
  options.min_half_width = 0.004;
  return options;
}

struct Outcome {
  std::vector<Vec3> velocity;
  FmmStatistics statistics;
};

/// @param target  empty: the sources' own array
Outcome evaluate(FmmMobility& fmm, const PointForces& from, const std::vector<Vec3>& target) {
  const Sources sources = on_device(from);
  const ConstVectors at = target.empty() ? sources.position : ConstVectors(to_device("target", target));
  const Vectors velocity("velocity", at.extent(0));
  Kokkos::deep_copy(velocity, 0.25);  // what is there already stays
  fmm.add_velocity(sources, at, velocity);
  std::vector<Vec3> list = to_host(velocity);
  for (Vec3& u : list) u = u - Vec3{0.25, 0.25, 0.25};
  return {list, fmm.statistics()};
}
Outcome evaluate(const FmmOptions& options, const PointForces& from) {
  FmmMobility fmm(viscosity, options);
  return evaluate(fmm, from, {});
}

FmmOptions on_path(FmmOptions options, const KernelPath path) {
  options.path = path;
  return options;
}

/// The same options on both paths, with operators kept for many clouds.
class BothPaths {
 public:
  explicit BothPaths(const FmmOptions& options)
      : device_(viscosity, on_path(options, KernelPath::device)),
        host_(viscosity, on_path(options, KernelPath::host)) {}

  void expect_agreement(const PointForces& from, const std::vector<Vec3>& target, const double allowed_difference,
                        const double allowed_error) {
    const Outcome device = evaluate(device_, from, target), host = evaluate(host_, from, target);
    EXPECT_LT(relative_error(device.velocity, host.velocity), allowed_difference);
    const auto& at = target.empty() ? from.position : target;
    EXPECT_LT(relative_error(device.velocity, reference::compute_stokeslet_velocity(from, at, viscosity)),
              allowed_error);
    EXPECT_EQ(device.statistics.n_boxes, host.statistics.n_boxes);
    EXPECT_EQ(device.statistics.n_leaves, host.statistics.n_leaves);
    EXPECT_EQ(device.statistics.n_levels, host.statistics.n_levels);
    EXPECT_EQ(device.statistics.smallest_half_width, host.statistics.smallest_half_width);
    EXPECT_EQ(device.statistics.work.near_pairs, host.statistics.work.near_pairs);
    EXPECT_EQ(device.statistics.work.far_pairs, host.statistics.work.far_pairs);
    EXPECT_EQ(device.statistics.plan.near_in_single, host.statistics.plan.near_in_single);
    EXPECT_FALSE(device.statistics.used_direct_sum);
    EXPECT_GT(device.statistics.memory_bytes, 0.0);
  }

 private:
  FmmMobility device_, host_;
};

TEST(DeviceFmm, AgreesWithTheHostInDouble) {
  for (const FarField far_field : {FarField::harmonic, FarField::stokeslet, FarField::regularized}) {
    BothPaths paths(options_for(far_field));
    for (const Cloud cloud : reference::all_clouds) {
      // Its operators differ from level to level, and take time.
      if (far_field == FarField::regularized && cloud != Cloud::cluster) continue;
      SCOPED_TRACE(reference::name_of(cloud) + ", far field " + std::to_string(static_cast<int>(far_field)));
      paths.expect_agreement(make_forces(cloud, 900, 2e-4, 2e-4), {}, 5e-13,
                             far_field == FarField::harmonic ? 1e-3 : 1e-2);
    }
  }
}

TEST(DeviceFmm, AgreesThroughEveryKindOfList) {
  PointForces from = make_forces(Cloud::cluster, 3000, 1e-4, 1e-4);
  const PointForces even = make_forces(Cloud::cube, 1500, 1e-4, 1e-4);
  from.position.insert(from.position.end(), even.position.begin(), even.position.end());
  from.force.insert(from.force.end(), even.force.begin(), even.force.end());
  from.blob.insert(from.blob.end(), even.blob.begin(), even.blob.end());
  for (const FarField far_field : {FarField::harmonic, FarField::stokeslet}) {
    FmmOptions options = options_for(far_field);
    options.order = 4;
    options.tolerance = 1.0;
    options.leaf_size = 40;
    BothPaths(options).expect_agreement(from, {}, 5e-13, 2e-2);
    Octree<ExecSpace> tree;
    const Vectors nodes = to_device("nodes", from.position);
    tree.build(ExecSpace(), nodes, nodes, make_octree_rules(options, choose_fmm_plan(options, 1e-4, 0)));
    EXPECT_GT(tree.v_list.n_entries, 0);
    EXPECT_GT(tree.w_list.n_entries, 0);
    EXPECT_GT(tree.x_list.n_entries, 0);
    EXPECT_GT(tree.x_direct.n_entries, 0);
  }
}

TEST(DeviceFmm, AgreesForTargetsApartAndManyBlobs) {
  Random random(4);
  const auto target = reference::make_cloud(Cloud::cluster, 900, {0.5, -3.1, 0.2}, 0.6, random);
  FmmOptions stokes_part = options_for(FarField::stokeslet);
  stokes_part.stokes_part_only = true;
  BothPaths harmonic(options_for(FarField::harmonic)), stokeslet(stokes_part);
  for (const Cloud cloud : {Cloud::cube, Cloud::tube}) {
    const PointForces from = make_forces(cloud, 2100, 1e-5, 4e-4);
    harmonic.expect_agreement(from, target, 5e-13, 1e-3);
    stokeslet.expect_agreement(from, target, 5e-13, 1e-2);
  }
}

TEST(DeviceFmm, AgreesInSinglePrecision) {
  for (const Precision precision : {Precision::in_single, Precision::automatic})
    // With blobs far below the leaves `automatic` sums the near field in double, the far field in single precision.
    for (const double blob : {2e-3, 1e-6}) {
      FmmOptions options = options_for(FarField::harmonic);
      options.precision = precision;
      options.min_half_width = 0.02;
      BothPaths paths(options);
      for (const Cloud cloud : {Cloud::cube, Cloud::cluster})
        paths.expect_agreement(make_forces(cloud, 1500, blob, blob), {}, 1e-4, 2e-3);
    }
}

using Teams = FmmEvaluator<TeamWorkers>;

/// The sum through teams of a size, without what FmmMobility does around it.
std::vector<Vec3> compute_by_teams(Teams& evaluator, const PointForces& from, const FmmOptions& options) {
  const Sources sources = on_device(from);
  EXPECT_TRUE(evaluator.take(sources, sources.position));
  EXPECT_TRUE(evaluator.compute(options, choose_fmm_plan(options, evaluator.largest_blob(), 0), viscosity));
  const Vectors velocity("velocity", from.position.size());
  evaluator.add_to(velocity);
  return to_host(velocity);
}

bool are_bitwise_equal(const std::vector<Vec3>& a, const std::vector<Vec3>& b) {
  return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(Vec3)) == 0;
}

TEST(DeviceFmm, TeamsAndRepetitionsChangeNoBit) {
  for (const FarField far_field : {FarField::harmonic, FarField::stokeslet})
    for (const Precision precision : {Precision::in_double, Precision::in_single}) {
      FmmOptions options = options_for(far_field);
      options.precision = precision;
      options.order = 4;
      options.tolerance = 1.0;
      Teams usual, by_kokkos(TeamWorkers(0)), alone(TeamWorkers(1));
      Teams in_pairs(TeamWorkers(ExecSpace().concurrency() > 1 ? 2 : 1));
      // Few, because a team of a busy host's threads waits for the one that has no core.
      const PointForces cloud = make_forces(Cloud::cluster, 300, 1e-4, 1e-3);
      const auto first = compute_by_teams(usual, cloud, options);
      EXPECT_GT(usual.statistics.work.far_pairs, 0.0);
      compute_by_teams(usual, make_forces(Cloud::tube, 3000, 1e-4, 1e-3), options);  // arrays with room to spare
      EXPECT_TRUE(are_bitwise_equal(compute_by_teams(usual, cloud, options), first));
      EXPECT_TRUE(are_bitwise_equal(compute_by_teams(by_kokkos, cloud, options), first));
      EXPECT_TRUE(are_bitwise_equal(compute_by_teams(alone, cloud, options), first));
      EXPECT_TRUE(are_bitwise_equal(compute_by_teams(in_pairs, cloud, options), first));
    }
}

TEST(DeviceFmm, FarPairsMayBeTakenAFewAtATime) {
  for (const FarField far_field : {FarField::harmonic, FarField::stokeslet}) {
    FmmOptions options = options_for(far_field);
    options.order = 4;
    options.tolerance = 1.0;
    const PointForces cloud = make_forces(Cloud::cluster, 900, 1e-4, 1e-3);
    Teams all_at_once;
    const auto expected = compute_by_teams(all_at_once, cloud, options);
    for (const std::size_t bytes : {std::size_t{1}, std::size_t{200'000}}) {
      Teams few(TeamWorkers(usual_team_size<ExecSpace>, bytes));
      EXPECT_LT(relative_error(compute_by_teams(few, cloud, options), expected), 1e-13) << bytes;
      EXPECT_LT(few.statistics.memory_bytes, all_at_once.statistics.memory_bytes);
    }
  }
}

TEST(DeviceFmm, WorksInTheLargeScratchMemory) {
  FmmOptions options = options_for(FarField::harmonic);
  options.order = 13;
  options.tolerance = 1e-6;
  options.min_half_width = 0.0;
  options.singular_cutoff = 1e-9;
  const int n_surface = 6 * 12 * 12 + 2;
  ASSERT_EQ(choose_scratch_level(static_cast<std::size_t>(n_surface) * 4 * sizeof(double) +
                                 source_tile * sizeof(FarSource<double>)),
            1);
  BothPaths(options).expect_agreement(make_forces(Cloud::line, 600, 1e-6, 1e-6), {}, 1e-12, 1e-5);
}

TEST(DeviceFmm, OneNodeAndNodesInOnePlace) {
  BothPaths paths(options_for(FarField::harmonic));
  const PointForces one{{{1.0, 2.0, 3.0}}, {{0.5, -0.2, 0.1}}, {1e-3}};
  paths.expect_agreement(one, {}, 1e-14, 1e-14);
  paths.expect_agreement(one, {{1.0, 2.1, 3.0}}, 1e-14, 1e-14);
  PointForces same = make_forces(Cloud::cube, 400, 1e-3, 2e-3);
  same.position.assign(same.position.size(), {0.1, 0.2, 0.3});
  paths.expect_agreement(same, {}, 1e-12, 1e-12);
}

TEST(DeviceFmm, APositionThatIsNoNumberMakesAllVelocitiesNone) {
  const test::MeantNan not_a_number_is_meant;
  PointForces from = make_forces(Cloud::cube, 800, 1e-4, 1e-3);
  from.position[17].y = std::numeric_limits<double>::quiet_NaN();
  const Outcome outcome = evaluate(options_for(FarField::harmonic), from);
  for (const Vec3& u : outcome.velocity) EXPECT_TRUE(std::isnan(u.x) && std::isnan(u.y) && std::isnan(u.z));
}

TEST(DeviceFmm, ChecksRaiseTheOrderAsOnTheHost) {
  PointForces from = make_forces(Cloud::tube, 3000, 1e-5, 1e-5);
  from.force.assign(from.force.size(), {1.0, 0.3, -0.2});  // far fields that add up
  ErrorRecord record[2];
  for (const KernelPath path : {KernelPath::host, KernelPath::device}) {
    FmmOptions options = on_path(options_for(FarField::harmonic), path);
    options.order = 4;
    options.tolerance = 3e-3;
    options.singular_cutoff = 0.5;  // cut far too short, until the order is raised
    options.check_every = 1;
    FmmMobility fmm(viscosity, options);
    const Outcome outcome = evaluate(fmm, from, {});
    EXPECT_LT(relative_error(outcome.velocity, reference::compute_stokeslet_velocity(from, from.position, viscosity)),
              3e-3);
    EXPECT_EQ(fmm.take_messages().size(), static_cast<std::size_t>(fmm.error_record().n_misses));
    record[path == KernelPath::device] = fmm.error_record();
  }
  EXPECT_GE(record[0].n_misses, 1);
  EXPECT_EQ(record[1].n_misses, record[0].n_misses);
  EXPECT_EQ(record[1].n_checks, record[0].n_checks);
  EXPECT_EQ(record[1].order, record[0].order);
  EXPECT_NEAR(record[1].last / record[0].last, 1.0, 1e-6);
  EXPECT_NEAR(record[1].largest / record[0].largest, 1.0, 1e-6);
}

TEST(DeviceFmm, SumsDirectlyWhereThatIsCheaper) {
  FmmOptions options = options_for(FarField::harmonic);
  options.direct_when_cheaper = true;
  options.order = 10;
  options.tolerance = 1e-6;
  options.min_half_width = 0.05;  // leaves so large that the lists hold nearly all pairs
  const PointForces from = make_forces(Cloud::cube, 1500, 1e-4, 1e-4);
  const Outcome outcome = evaluate(options, from);
  EXPECT_TRUE(outcome.statistics.used_direct_sum);
  EXPECT_LT(relative_error(outcome.velocity, reference::compute_stokeslet_velocity(from, from.position, viscosity)),
            1e-13);
}

TEST(DeviceFmm, RefusesSeveralBlobsWhereTheFarFieldNeedsOne) {
  EXPECT_THROW(evaluate(options_for(FarField::regularized), make_forces(Cloud::cube, 900, 1e-4, 2e-4)), Error);
}

}  // namespace
}  // namespace skein
