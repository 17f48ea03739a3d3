#include <skein/core/error.hpp>
#include <skein/physics/direct_mobility.hpp>
#include <skein/physics/fmm_mobility.hpp>

#include "fmm/tree_fit.hpp"
#include "tests/accuracy/fmm_cases.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

// Trees that serve several sums of a step, on hosts and in the memory of a device.

namespace skein {
namespace {

using reference::PointForces;
using reference::Random;

std::vector<Vec3> velocities(FmmMobility& fmm, const PointForces& from) {
  const Sources sources = on_device(from);
  const Vectors velocity("velocity", sources.position.extent(0));
  fmm.add_velocity(sources, sources.position, velocity);
  return to_host(velocity);
}

std::vector<Vec3> exact_velocities(const PointForces& from) {
  const Sources sources = on_device(from);
  const Vectors velocity("velocity", sources.position.extent(0));
  DirectMobility(viscosity, Precision::in_double).add_velocity(sources, sources.position, velocity);
  return to_host(velocity);
}

/// Every coordinate by +- distance: no node can leave its leaf by more.
PointForces moved(PointForces from, const double distance, Random& random) {
  for (Vec3& x : from.position)
    x = x +
        distance * Vec3{random.bits() % 2 ? 1.0 : -1.0, random.bits() % 2 ? 1.0 : -1.0, random.bits() % 2 ? 1.0 : -1.0};
  return from;
}

bool are_equal(const std::vector<Vec3>& one, const std::vector<Vec3>& other) {
  for (std::size_t i = 0; i < one.size(); ++i)
    if (one[i].x != other[i].x || one[i].y != other[i].y || one[i].z != other[i].z) return false;
  return one.size() == other.size();
}

class KeptTree : public testing::TestWithParam<KernelPath> {
 protected:
  FmmOptions options(const double tolerance) const {
    FmmOptions options;
    options.tolerance = tolerance;
    options.leaf_size = 20;  // small enough for a far field
    options.path = GetParam();
    return options;
  }
};

// Moved once more from where the tree was made, just short of the margin: the worst that a kept tree meets.
TEST_P(KeptTree, IsWithinTheToleranceAtItsMargin) {
  const int n_cases = GetParam() == KernelPath::host ? 24 : 6;
  Random random(4711);
  int n_kept = 0;
  double worst = 0.0;
  for (int k = 0; k < n_cases; ++k) {
    const int n = static_cast<int>(random.log_uniform(300.0, 3000.0));
    const std::vector<Vec3> nodes =
        k % 5 == 4 ? make_spiral(n / 18)
                   : reference::make_cloud(reference::all_clouds[k % 4], n, random.in_cube(2.0), 1.0, random);
    const double cell = 1.0 / std::cbrt(nodes.size() / 20.0);
    PointForces from = with_forces(nodes, cell * random.log_uniform(1e-4, 0.1), random.bits());
    if (k % 3 == 0)
      for (Vec3& f : from.force) f = f + Vec3{3.0, 0.0, 1.0};
    const double tolerance = random.log_uniform(1e-9, 1e-3);
    FmmMobility fmm(viscosity, options(tolerance));
    fmm.begin_step();
    velocities(fmm, from);
    const double reach = 0.999 * leaf_margin * fmm.statistics().smallest_half_width;
    const PointForces later = moved(from, reach, random);
    const double error = error_of(velocities(fmm, later), exact_velocities(later));
    fmm.end_step();
    EXPECT_EQ(fmm.statistics().n_trees, 1) << "case " << k;
    EXPECT_LE(error, tolerance) << "case " << k << ": " << nodes.size() << " nodes";
    worst = std::fmax(worst, error / tolerance);
    n_kept += fmm.statistics().work.far_pairs > 0.0;
  }
  RecordProperty("worst_error_over_tolerance", std::to_string(worst));
  EXPECT_GT(n_kept, n_cases / 2) << "too few cases with a far field";
}

TEST_P(KeptTree, IsMadeAnewWhereANodeStraysOrIsAnother) {
  const PointForces from = with_forces(make_tube(120), 1e-4, 3);
  FmmMobility fmm(viscosity, options(1e-4));
  const auto n_trees = [&] { return fmm.statistics().n_trees; };
  fmm.begin_step();
  velocities(fmm, from);
  velocities(fmm, from);
  EXPECT_EQ(n_trees(), 1);
  PointForces strayed = from;
  strayed.position[7] = strayed.position[7] + Vec3{0.0, 2.1 * fmm.statistics().smallest_half_width, 0.0};
  EXPECT_LE(error_of(velocities(fmm, strayed), exact_velocities(strayed)), 1e-4);
  EXPECT_EQ(n_trees(), 2);
  PointForces fewer = from;
  fewer.position.resize(1800), fewer.force.resize(1800), fewer.blob.resize(1800);
  EXPECT_LE(error_of(velocities(fmm, fewer), exact_velocities(fewer)), 1e-4);
  EXPECT_EQ(n_trees(), 3);
}

// What a restarted run needs: a step begins as if nothing had been before, and sums outside of steps stand alone.
TEST_P(KeptTree, IsForgottenAtTheEndOfAStep) {
  Random random(5);
  const PointForces from = with_forces(make_spiral(120), 1e-4, 3);
  const PointForces later = moved(from, 2e-5, random);
  FmmMobility fmm(viscosity, options(1e-4)), fresh(viscosity, options(1e-4));
  const auto alone = velocities(fresh, later);
  fmm.begin_step();
  velocities(fmm, from);
  const auto kept = velocities(fmm, later);
  fmm.end_step();
  EXPECT_EQ(fmm.statistics().n_trees, 1);
  EXPECT_FALSE(are_equal(kept, alone)) << "or this test shows nothing";
  EXPECT_TRUE(are_equal(velocities(fmm, later), alone)) << "outside of steps";
  fmm.begin_step();
  EXPECT_TRUE(are_equal(velocities(fmm, later), alone)) << "first in a step";
  fmm.end_step();
}

TEST_P(KeptTree, LetsNoNodeThatIsNoNumberPass) {
  PointForces from = with_forces(make_tube(120), 1e-4, 3);
  FmmMobility fmm(viscosity, options(1e-4));
  fmm.begin_step();
  velocities(fmm, from);
  from.position[11].y = std::nan("");
  for (const Vec3 u : velocities(fmm, from)) EXPECT_TRUE(std::isnan(u.x));
}

INSTANTIATE_TEST_SUITE_P(Paths, KeptTree, testing::Values(KernelPath::host, KernelPath::device),
                         [](const auto& path) { return path.param == KernelPath::host ? "host" : "device"; });

}  // namespace
}  // namespace skein
