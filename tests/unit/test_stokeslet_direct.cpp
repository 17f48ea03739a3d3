#include <skein/core/error.hpp>
#include <skein/fibers/fiber.hpp>

#include "tests/unit/stokeslet_case.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <numbers>

namespace skein {
namespace {

using reference::Cloud;

struct Row {
  Sum sum;
  Precision precision;
  double tolerance;  ///< of the largest velocity; three to four times what was measured
};

std::ostream& operator<<(std::ostream& out, const Row& row) {
  return out << name_of(row.sum) << (row.precision == Precision::in_double ? "_in_double" : "_in_single");
}

class StokesletSum : public ::testing::TestWithParam<Row> {
 protected:
  bool symmetric() const { return GetParam().sum == Sum::symmetric || GetParam().sum == Sum::rounds; }
  int smallest() const { return symmetric() ? min_symmetric_nodes : 1; }
  reference::PointForces sources(const Cloud cloud, const int n_sources, const Vec3 center = {}) const {
    return symmetric() ? make_equal_sources(cloud, n_sources, center, 7) : make_sources(cloud, n_sources, center, 7);
  }
  std::vector<Vec3> compute(const reference::PointForces& from, const std::vector<Vec3>& target) const {
    return compute_velocity(GetParam().sum, GetParam().precision, from, target);
  }
  /// Error of the velocities at the sources themselves, relative to the largest.
  double error_at_sources(const reference::PointForces& from) const {
    return reference::relative_error(compute(from, from.position),
                                     reference::compute_stokeslet_velocity(from, from.position, test_viscosity));
  }
};

INSTANTIATE_TEST_SUITE_P(
    , StokesletSum,
    ::testing::Values(Row{Sum::general, Precision::in_double, 4e-15}, Row{Sum::general, Precision::in_single, 2e-6},
                      Row{Sum::symmetric, Precision::in_double, 4e-15}, Row{Sum::symmetric, Precision::in_single, 2e-6},
                      Row{Sum::rounds, Precision::in_double, 4e-15}, Row{Sum::rounds, Precision::in_single, 2e-6},
                      Row{Sum::teams, Precision::in_double, 4e-15}, Row{Sum::teams, Precision::in_single, 2e-6}),
    ::testing::PrintToStringParamName());

// Both sides of every edge of packs (4 to 16 lanes), blocks (64), tiles (128), sides (192) and of the tournament.
constexpr int sizes[] = {1,   2,   7,   63,  64,  65,  127, 128, 129, 191,  192,  193, 255,
                         256, 257, 383, 384, 385, 575, 576, 577, 769, 1000, 1440, 1537};

TEST_P(StokesletSum, AgreesWithTheReferenceAtEverySize) {
  double worst = 0.0;
  for (const int n : sizes)
    if (n >= smallest()) worst = std::max(worst, error_at_sources(sources(Cloud::tube, n)));
  EXPECT_LT(worst, GetParam().tolerance);
}

TEST_P(StokesletSum, AgreesWithTheReferenceForEveryCloud) {
  for (const Cloud cloud : reference::all_clouds)
    EXPECT_LT(error_at_sources(sources(cloud, 700)), GetParam().tolerance) << reference::name_of(cloud);
}

// Tiles of a shuffled tube are as wide as the tube: no tile is far from another.
TEST_P(StokesletSum, OrderOfNodesDoesNotMatter) {
  reference::PointForces shuffled = sources(Cloud::tube, 900);
  reference::Random random(23);
  for (std::size_t i = shuffled.position.size() - 1; i > 0; --i) {
    const std::size_t j = random.bits() % (i + 1);
    std::swap(shuffled.position[i], shuffled.position[j]);
    std::swap(shuffled.force[i], shuffled.force[j]);
    std::swap(shuffled.blob[i], shuffled.blob[j]);
  }
  EXPECT_LT(error_at_sources(shuffled), GetParam().tolerance);
}

// Differences are taken in double whatever the precision of a pair: a fiber does not know where it is.
TEST_P(StokesletSum, LosesNothingFarFromTheOrigin) {
  for (const double shift : {1e3 / 3.0, 1e6 / 3.0, 1e9 / 3.0})
    EXPECT_LT(error_at_sources(sources(Cloud::tube, 600, {shift, -2.0 * shift, 0.7 * shift})), GetParam().tolerance)
        << shift;
}

// Two fibers a long way apart: tiles with and without low parts of coordinates meet in one sum.
TEST_P(StokesletSum, AgreesForFibersFarApart) {
  reference::PointForces both = sources(Cloud::tube, 300);
  const reference::PointForces other = sources(Cloud::cluster, 300, {40.0, 3.0, -900.0});
  both.position.insert(both.position.end(), other.position.begin(), other.position.end());
  both.force.insert(both.force.end(), other.force.begin(), other.force.end());
  both.blob.insert(both.blob.end(), other.blob.begin(), other.blob.end());
  EXPECT_LT(error_at_sources(both), GetParam().tolerance);
}

// Blobs and nearest neighbours far below a tile's extent: single precision needs the low parts of coordinates.
TEST_P(StokesletSum, AgreesForClosePairsFarFromEachOther) {
  reference::PointForces pairs = sources(Cloud::cube, 400);
  const double close = 3e-5;
  for (std::size_t i = 0; i < pairs.position.size(); ++i) {
    pairs.blob[i] = close;
    if (i % 2 == 1) pairs.position[i] = pairs.position[i - 1] + Vec3{0.6 * close, -0.3 * close, close};
  }
  EXPECT_LT(error_at_sources(pairs), GetParam().tolerance);
}

TEST_P(StokesletSum, AgreesForCoincidentNodes) {
  reference::PointForces coincident = sources(Cloud::cube, 400);
  for (std::size_t i = 0; i + 5 < coincident.position.size(); i += 3)
    coincident.position[i + 5] = coincident.position[i];
  EXPECT_LT(error_at_sources(coincident), GetParam().tolerance);
  coincident.position.assign(coincident.position.size(), Vec3{0.3, -0.1, 2.0});
  EXPECT_LT(error_at_sources(coincident), GetParam().tolerance);
}

TEST_P(StokesletSum, AccumulatesIntoTheVelocity) {
  const reference::PointForces from = sources(Cloud::tube, 300);
  reference::Random random(99);
  const std::vector<Vec3> before = reference::make_random_vectors(300, 0.2, random);
  std::vector<Vec3> expected = reference::compute_stokeslet_velocity(from, from.position, test_viscosity);
  for (std::size_t i = 0; i < expected.size(); ++i) expected[i] = expected[i] + before[i];
  const auto after = add_velocity(GetParam().sum, GetParam().precision, from, from.position, before);
  EXPECT_LT(reference::relative_error(after, expected), GetParam().tolerance);
}

TEST_P(StokesletSum, ForceThatIsNotANumberReachesEveryVelocity) {
  for (const int bad : {0, 70, 299}) {
    reference::PointForces from = sources(Cloud::tube, 300);
    from.force[bad].y = std::numeric_limits<double>::quiet_NaN();
    for (const Vec3 u : compute(from, from.position))
      ASSERT_TRUE(std::isnan(u.x) && std::isnan(u.y) && std::isnan(u.z));
  }
}

TEST_P(StokesletSum, PositionThatIsNotANumberReachesEveryVelocity) {
  for (const int bad : {0, 70, 299}) {
    reference::PointForces from = sources(Cloud::tube, 300);
    from.position[bad].z = std::numeric_limits<double>::quiet_NaN();
    for (const Vec3 u : compute(from, from.position))
      ASSERT_TRUE(std::isnan(u.x) && std::isnan(u.y) && std::isnan(u.z));
  }
}

TEST_P(StokesletSum, RepeatsItselfToTheBit) {
  const reference::PointForces from = sources(Cloud::cluster, 1111);
  const auto first = compute(from, from.position), second = compute(from, from.position);
  EXPECT_EQ(std::memcmp(first.data(), second.data(), first.size() * sizeof(Vec3)), 0);
}

TEST_P(StokesletSum, RefusesArraysOfDifferentLengths) {
  reference::PointForces from = sources(Cloud::line, 300);
  const std::vector<Vec3> target = from.position;
  from.blob.pop_back();
  EXPECT_THROW(compute(from, target), Error);
  from = sources(Cloud::line, 300);
  from.force.pop_back();
  EXPECT_THROW(compute(from, target), Error);
  from = sources(Cloud::line, 300);
  EXPECT_THROW(add_velocity(GetParam().sum, GetParam().precision, from, target, std::vector<Vec3>(299)), Error);
}

/// The two sums whose targets need not be the sources.
using SumAtTargets = StokesletSum;
INSTANTIATE_TEST_SUITE_P(, SumAtTargets,
                         ::testing::Values(Row{Sum::general, Precision::in_double, 6e-15},
                                           Row{Sum::general, Precision::in_single, 4e-6},
                                           Row{Sum::teams, Precision::in_double, 6e-15},
                                           Row{Sum::teams, Precision::in_single, 4e-6}),
                         ::testing::PrintToStringParamName());

TEST_P(SumAtTargets, AgreesWithTheReferenceForOtherTargets) {
  reference::Random random(31);
  for (const int n_sources : {1, 65, 129, 400})
    for (const int n_targets : {1, 5, 63, 64, 65, 130, 500}) {
      const reference::PointForces from = sources(Cloud::cube, n_sources);
      const auto target = reference::make_cloud(Cloud::tube, n_targets, {0.1, 0.0, 0.2}, 0.5, random);
      EXPECT_LT(reference::relative_error(compute(from, target),
                                          reference::compute_stokeslet_velocity(from, target, test_viscosity)),
                GetParam().tolerance)
          << n_sources << " sources, " << n_targets << " targets";
    }
}

TEST_P(SumAtTargets, NoSourcesLeaveTheVelocityAlone) {
  const std::vector<Vec3> target(70, Vec3{0.1, 0.2, 0.3}), before(70, Vec3{-1.0, 2.0, 0.5});
  EXPECT_EQ(add_velocity(GetParam().sum, GetParam().precision, {}, target, before), before);
}

TEST_P(SumAtTargets, NoTargetsAreAllowed) { EXPECT_TRUE(compute(sources(Cloud::cube, 10), {}).empty()); }

TEST_P(SumAtTargets, OneNodeMovesByItsForceOverFourPiViscosityBlob) {
  const Vec3 force{0.3, -0.7, 1.1};
  const double blob = 0.013;
  const Vec3 u = compute({{{0.4, 5.0, -2.0}}, {force}, {blob}}, {{0.4, 5.0, -2.0}}).front();
  const Vec3 expected = force / (4.0 * std::numbers::pi * test_viscosity * blob);
  EXPECT_LT(norm(u - expected), GetParam().tolerance * norm(expected));
}

TEST_P(SumAtTargets, PushesTwiceAsHardAheadAsBesideFarAway) {
  const Vec3 force{0.0, 0.9, 0.0};
  const double far = 1e4, blob = 0.02;  // the blob changes the ratio by 2 (blob / far)^2 = 8e-12
  const auto u = compute({{{0.5, 0.5, 0.5}}, {force}, {blob}}, {{0.5, 0.5 + far, 0.5}, {0.5, 0.5, 0.5 - far}});
  EXPECT_NEAR(u[0].y / u[1].y, 2.0, std::max(1e-9, 2.0 * GetParam().tolerance));
  EXPECT_NEAR(u[0].y * 4.0 * std::numbers::pi * test_viscosity * far / force.y, 1.0,
              std::max(1e-9, 2.0 * GetParam().tolerance));
}

TEST(StokesletTeams, AgreesWithTheReferenceForAnyNumberOfRuns) {
  const reference::PointForces from = make_sources(Cloud::tube, 1301, {}, 7);
  const auto exact = reference::compute_stokeslet_velocity(from, from.position, test_viscosity);
  const std::vector<Vec3> rest(from.position.size());
  for (const int n_runs : {1, 2, 5, 11, 40, 1301})
    for (const Precision precision : {Precision::in_double, Precision::in_single})
      EXPECT_LT(reference::relative_error(
                    add_velocity_by_teams<ExecSpace>(precision, from, from.position, rest, {.n_runs = n_runs}), exact),
                precision == Precision::in_double ? 4e-15 : 2e-6)
          << n_runs << " runs";
}

// What is promised of pairs in single precision: the 2-norm of all errors, for the blobs and nodes of the paper's
// fiber.
TEST(StokesletTeams, SinglePairsOfAFiberMissByLessThan3e7) {
  FiberConfig config;
  config.sections = 80;
  const std::vector<Fiber> fibers = make_fibers({config});
  reference::Random random(5);
  const std::vector<Vec3> nodes = make_surface_nodes(fibers);
  const reference::PointForces from{nodes, reference::make_random_vectors(static_cast<int>(nodes.size()), 1.0, random),
                                    make_blobs(fibers)};
  const auto exact = reference::compute_stokeslet_velocity(from, from.position, test_viscosity);
  const auto got = add_velocity_by_teams<ExecSpace>(Precision::in_single, from, from.position,
                                                    std::vector<Vec3>(nodes.size()), {.n_runs = 23});
  double difference = 0.0, size = 0.0;
  for (std::size_t i = 0; i < got.size(); ++i) {
    difference += dot(got[i] - exact[i], got[i] - exact[i]);
    size += dot(exact[i], exact[i]);
  }
  EXPECT_LT(std::sqrt(difference / size), 3e-7);
  EXPECT_GT(std::sqrt(difference / size), 1e-9) << "these pairs were not single";
}

// Twice as many threads as the device runs at once, and at least 64 sources a team: the splits that were fastest on an
// H100 (270 336 threads).
TEST(StokesletTeams, SplitIsThatOfTheFastestSumsMeasured) {
  constexpr int h100 = 132 * 2048;
  EXPECT_EQ(choose_team_split(h100, 1440, 1440).n_runs, 23);
  EXPECT_EQ(choose_team_split(h100, 5418, 5418).n_runs, 85);
  EXPECT_EQ(choose_team_split(h100, 23634, 23634).n_runs, 23);
  EXPECT_EQ(choose_team_split(h100, 378144, 378144).n_runs, 2);
  EXPECT_EQ(choose_team_split(h100, 10'000'000, 10'000'000).n_runs, 1);
  EXPECT_EQ(choose_team_split(h100, 1, 64).n_runs, 1);
  EXPECT_EQ(choose_team_split(h100, 1'000'000, 64).n_runs, 8448);
  EXPECT_EQ(choose_team_split(1, 3, 5).n_runs, 1);
}

TEST(SymmetricStokeslet, RefusesTooFewNodes) {
  const reference::PointForces few = make_equal_sources(Cloud::tube, min_symmetric_nodes - 1, {}, 7);
  EXPECT_THROW(compute_velocity(Sum::symmetric, Precision::in_double, few, few.position), Error);
}

// Beyond max_tiles tiles of nodes_per_tile nodes the tiles grow past what is in flight at once.
TEST(SymmetricStokeslet, AgreesWithTheGeneralSumForManyNodes) {
  const reference::PointForces many = make_equal_sources(Cloud::tube, 13001, {}, 7);
  EXPECT_LT(reference::relative_error(compute_velocity(Sum::symmetric, Precision::in_double, many, many.position),
                                      compute_velocity(Sum::general, Precision::in_double, many, many.position)),
            1e-14);
}

}  // namespace
}  // namespace skein
