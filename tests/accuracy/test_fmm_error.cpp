#include <skein/core/error.hpp>
#include <skein/physics/direct_mobility.hpp>
#include <skein/physics/fmm_mobility.hpp>

#include "tests/accuracy/fmm_cases.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <utility>
#include <vector>

namespace skein {
namespace {

using reference::Cloud;
using reference::PointForces;
using reference::Random;

/// @param target  empty: the sources' own array
struct Result {
  double error;
  FmmStatistics statistics;
};
Result compare_with_direct(const PointForces& from, const std::vector<Vec3>& target, const FmmOptions& options) {
  const Sources sources = on_device(from);
  const Vectors at = target.empty() ? Vectors() : to_device("target", target);
  const ConstVectors targets = target.empty() ? sources.position : ConstVectors(at);
  const Vectors got("got", targets.extent(0)), exact("exact", targets.extent(0));
  FmmMobility fmm(viscosity, options);
  fmm.add_velocity(sources, targets, got);
  DirectMobility(viscosity, Precision::in_double).add_velocity(sources, targets, exact);
  return {error_of(to_host(got), to_host(exact)), fmm.statistics()};
}

/// Error between the nearest well-separated boxes.
double nearest_boxes_error(const int order, const double blob_over_half_width, const double cutoff,
                           const FarField far_field, const bool stokes_part_only) {
  // Cells fit the nodes' extent, or come in steps where operators depend on them.
  const NearestBoxes boxes(blob_over_half_width, 5, far_field == FarField::regularized ? 0.9999 : 1.0);
  FmmOptions options;
  options.far_field = far_field;
  options.stokes_part_only = stokes_part_only;
  options.tolerance = 1.0;
  options.order = order;
  options.singular_cutoff = cutoff;
  options.leaf_size = 1;
  options.min_half_width = boxes.half_width;
  options.precision = Precision::in_double;
  const Result result = compare_with_direct(boxes.from, boxes.target, options);
  EXPECT_EQ(result.statistics.work.near_pairs, 0.0);
  EXPECT_EQ(result.statistics.work.far_pairs, 1.0);
  return result.error;
}

// Orders of magnitude: tests/reference/fmm_nearest_boxes.py has a pseudo-inverse, forces and places of its own.
TEST(FmmError, FallsWithTheOrderAsMeasuredElsewhere) {
  const std::pair<int, double> measured[] = {{4, 2.0e-3},  {6, 4.9e-5},  {8, 1.4e-6},
                                             {10, 9.8e-8}, {12, 1.8e-9}, {14, 1.0e-10}};
  for (const auto& [order, error] : measured) {
    const double got = nearest_boxes_error(order, 1e-4, 1e-15, FarField::harmonic, false);
    EXPECT_LT(got, 3.0 * error) << "order " << order;
    EXPECT_GT(got, error / 30.0) << "order " << order;
  }
}

TEST(FmmError, BlobsLeaveAFloorOfTheFourthPower) {
  for (const double ratio : {0.04, 0.1, 0.2, 0.4}) {
    const double got = nearest_boxes_error(14, ratio, 1e-15, FarField::harmonic, false);
    EXPECT_LT(got, 2.0 * harmonic_floor(ratio, 1.0)) << ratio;
    EXPECT_GT(got, 0.25 * harmonic_floor(ratio, 1.0)) << ratio;
  }
}

TEST(FmmError, StokesletsAmplifyBlobsUnlessCutOff) {
  const double uncut = nearest_boxes_error(10, 0.2, 1e-15, FarField::stokeslet, false);
  EXPECT_GT(uncut, 3e-4);
  EXPECT_LT(nearest_boxes_error(10, 0.2, 1e-9, FarField::stokeslet, false), 1e-5);
  EXPECT_LT(nearest_boxes_error(10, 0.2, 1e-15, FarField::stokeslet, true), 5e-5);
  EXPECT_LT(nearest_boxes_error(10, 0.2, 1e-9, FarField::regularized, false), 5e-6);
}

TEST(FmmError, StaysWithinTheToleranceOnFibersAndClouds) {
  Random random(8);
  const std::pair<const char*, std::vector<Vec3>> shapes[] = {
      {"tube", make_tube(200)},
      {"spiral", make_spiral(200)},
      {"cube", reference::make_cloud(Cloud::cube, 4000, {5.0, -2.0, 1.0}, 0.08, random)}};
  for (const auto& [name, nodes] : shapes)
    for (const double tolerance : {1e-2, 1e-3, 1e-4, 1e-5, 1e-6, 1e-7, 1e-9}) {
      FmmOptions options;
      options.tolerance = tolerance;
      options.leaf_size = 30;  // small enough for a far field
      const double blob = tolerance < 1e-4 ? 1e-4 : fiber_blob;
      const Result result = compare_with_direct(with_forces(nodes, blob, 3), {}, options);
      EXPECT_LT(result.error, tolerance) << name;
      EXPECT_TRUE(tolerance == 1e-2 || result.statistics.work.far_pairs > 0.0) << name << tolerance;
    }
}

TEST(FmmError, EveryFarFieldKeepsItsPromise) {
  for (const FarField far_field : {FarField::harmonic, FarField::stokeslet, FarField::regularized})
    for (const double tolerance : {1e-2, 1e-3}) {
      FmmOptions options;
      options.far_field = far_field;
      options.tolerance = tolerance;
      options.leaf_size = 30;
      EXPECT_LT(compare_with_direct(with_forces(make_spiral(200), 5e-4, 4), {}, options).error, tolerance)
          << static_cast<int>(far_field);
    }
}

TEST(FmmError, TargetsMayDifferFromSources) {
  Random random(9);
  PointForces from = with_forces(make_tube(200), 3e-4, 5);
  std::vector<Vec3> target = reference::make_cloud(Cloud::cube, 1500, {0.1, 0.0, 0.0}, 0.2, random);
  target.push_back({40.0, -3.0, 2.0});  // far outside
  FmmOptions options;
  options.tolerance = 1e-6;
  options.leaf_size = 20;
  EXPECT_LT(compare_with_direct(from, target, options).error, 1e-6);
  from.position.resize(7);
  from.force.resize(7);
  from.blob.resize(7);
  EXPECT_LT(compare_with_direct(from, target, options).error, 1e-6) << "few sources, many targets";
  EXPECT_LT(
      compare_with_direct(with_forces(make_tube(100), 3e-4, 5), {{0.05, 0.001, 0.0}, {0.3, 0.0, 0.0}}, options).error,
      1e-6)
      << "many sources, few targets";
}

TEST(FmmError, BlobsMayDiffer) {
  Random random(10);
  PointForces from = with_forces(make_spiral(200), 0.0, 5);
  from.blob = reference::make_random_lengths(static_cast<int>(from.position.size()), 1e-6, 2e-3, random);
  for (const double tolerance : {1e-3, 1e-5, 1e-7}) {
    FmmOptions options;
    options.tolerance = tolerance;
    options.leaf_size = 20;
    EXPECT_LT(compare_with_direct(from, {}, options).error, tolerance);
  }
  FmmOptions options;
  options.far_field = FarField::regularized;
  options.tolerance = 1e-2;
  EXPECT_THROW(compare_with_direct(from, {}, options), Error) << "one blob for all is needed";
}

TEST(FmmError, DegenerateInputsAreRight) {
  std::vector<Vec3> line, twice, powers;
  for (int i = 0; i < 900; ++i) line.push_back({0.01 * i, 0.5, -0.25});
  for (int i = 0; i < 900; ++i) twice.push_back({0.01 * (i / 3), 0.3 * ((i / 3) % 7), 0.0});
  for (int i = 0; i < 600; ++i) powers.push_back({std::ldexp(1.0, -(i / 6)), 1.0, std::ldexp(1.0, -(i % 6))});
  const std::vector<std::vector<Vec3>> inputs = {
      std::vector<Vec3>(800, {0.1, 0.2, 0.3}), line,        twice, powers, {{1.0, 2.0, 3.0}},
      {{1.0, 2.0, 3.0}, {1.0, 2.0, 3.0}},      make_tube(1)};
  for (std::size_t k = 0; k < inputs.size(); ++k)
    for (const double blob : {1e-12, 1e-5, 3e-3, 10.0})
      for (const double tolerance : {1e-4, 1e-8}) {
        FmmOptions options;
        options.tolerance = tolerance;
        options.leaf_size = 10;
        EXPECT_LE(compare_with_direct(with_forces(inputs[k], blob, 6), {}, options).error, tolerance)
            << "input " << k << ", blob " << blob;
      }
}

/// Within the tolerance or refused, whatever the nodes and their blobs.
void expect_no_silent_miss(const int n_cases, const std::uint64_t seed) {
  Random random(seed);
  int n_with_far_field = 0, n_refused = 0;
  for (int k = 0; k < n_cases; ++k) {
    const int n = static_cast<int>(random.log_uniform(20.0, 3000.0));
    PointForces from;
    std::vector<Vec3> nodes;
    if (k % 6 == 5)
      nodes = make_spiral(math::larger(1, n / 18));
    else if (k % 6 == 4)
      nodes.assign(static_cast<std::size_t>(n), {0.2, 0.1, -0.4});
    else
      nodes = reference::make_cloud(reference::all_clouds[k % 4], n, random.in_cube(2.0), 1.0, random);
    if (k % 7 == 0)
      nodes.insert(nodes.end(), nodes.begin(), nodes.begin() + static_cast<std::ptrdiff_t>(nodes.size() / 2));
    const double cell = 1.0 / std::cbrt(nodes.size() / 20.0);
    from = with_forces(nodes, cell * random.log_uniform(1e-4, 10.0), random.bits());
    if (k % 3 == 0)
      for (Vec3& f : from.force) f = f + Vec3{3.0, 0.0, 1.0};
    FmmOptions options;
    options.tolerance = random.log_uniform(1e-11, 1e-2);
    options.leaf_size = 1 + static_cast<int>(random.uniform(0.0, 60.0));
    if (k % 5 == 0) options.precision = Precision::in_double;
    try {
      const Result result = compare_with_direct(from, {}, options);
      EXPECT_LE(result.error, options.tolerance)
          << "case " << k << ": " << nodes.size() << " nodes, order " << result.statistics.plan.order;
      n_with_far_field += result.statistics.work.far_pairs > 0.0;
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), ExitCode::scene_error) << error.what();
      ++n_refused;
    }
  }
  EXPECT_GT(n_with_far_field, n_cases / 6);
  EXPECT_LT(n_refused, n_cases / 4);
}
TEST(FmmError, NeverMissesSilently) { expect_no_silent_miss(20, 7); }
TEST(FmmErrorSlow, NeverMissesSilently) { expect_no_silent_miss(200, 2026); }

// No near field hides the error of the far one.
TEST(FmmError, NeverMissesApartFromTheSources) {
  for (const double tolerance : {1e-3, 1e-4, 1e-5}) {
    FmmOptions options;
    options.tolerance = tolerance;
    options.leaf_size = 6;
    FmmMobility fmm(viscosity, options);
    Random random(301);
    int n_with_far_field = 0;
    for (int k = 0; k < 60; ++k) {
      const double size = random.log_uniform(0.01, 100.0), cell = size / std::cbrt(260.0);
      PointForces from;
      from.position =
          reference::make_cloud(reference::all_clouds[k % 4], 260, random.in_cube(3.0 * size), size, random);
      from.force = reference::make_random_vectors(260, 2.0, random);
      from.blob = reference::make_random_lengths(260, 0.001 * cell, 0.1 * cell, random);
      const Vec3 beside = from.position.front() + random.in_cube(size);
      const Vectors target = to_device("target", reference::make_cloud(Cloud::cube, 150, beside, 2.0 * size, random));
      const Sources sources = on_device(from);
      const Vectors got("got", 150), exact("exact", 150);
      fmm.add_velocity(sources, target, got);
      DirectMobility(viscosity, Precision::in_double).add_velocity(sources, target, exact);
      EXPECT_LE(error_of(to_host(got), to_host(exact)), tolerance) << "case " << k;
      n_with_far_field += fmm.statistics().work.far_pairs > 0.0;
    }
    EXPECT_GT(n_with_far_field, 30) << tolerance;
  }
}

TEST(FmmOptionsCheck, RefusesWhatCannotBeDelivered) {
  const auto refused = [](const auto& change) {
    FmmOptions options;
    change(options);
    try {
      FmmMobility fmm(viscosity, options);
      const Sources sources = on_device(with_forces(make_tube(60), fiber_blob, 1));
      fmm.add_velocity(sources, sources.position, Vectors("velocity", sources.position.extent(0)));
    } catch (const Error& error) {
      return error.code() == ExitCode::scene_error;
    }
    return false;
  };
  EXPECT_FALSE(refused([](FmmOptions&) {}));
  EXPECT_TRUE(refused([](FmmOptions& o) { o.tolerance = 1e-14; }));
  EXPECT_TRUE(refused([](FmmOptions& o) { o.tolerance = 0.0; }));
  EXPECT_TRUE(refused([](FmmOptions& o) { o.tolerance = std::nan(""); }));
  EXPECT_TRUE(refused([](FmmOptions& o) { o.order = 2; }));
  EXPECT_TRUE(refused([](FmmOptions& o) {
    o.order = 4;
    o.tolerance = 1e-6;
  }));
  EXPECT_TRUE(refused([](FmmOptions& o) { o.min_half_width = 0.002; })) << "below the floor law";
  EXPECT_TRUE(refused([](FmmOptions& o) {
    o.precision = Precision::in_single;
    o.tolerance = 1e-8;
  }));
  EXPECT_TRUE(refused([](FmmOptions& o) { o.leaf_size = -1; }));
}

TEST(FmmCheck, ChoosesTheDirectSumWhereItIsCheaper) {
  FmmOptions options;
  options.direct_when_cheaper = true;
  EXPECT_TRUE(compare_with_direct(with_forces(make_tube(20), fiber_blob, 1), {}, options).statistics.used_direct_sum);
  EXPECT_FALSE(compare_with_direct(with_forces(make_tube(300), fiber_blob, 1), {}, options).statistics.used_direct_sum);
  options.tolerance = 1e-15;
  const Result result = compare_with_direct(with_forces(make_tube(300), fiber_blob, 1), {}, options);
  EXPECT_TRUE(result.statistics.used_direct_sum);
  EXPECT_EQ(result.error, 0.0);
}

}  // namespace
}  // namespace skein
