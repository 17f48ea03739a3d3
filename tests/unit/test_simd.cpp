#include "kernels/regularized_stokeslet.hpp"
#include "kernels/simd_transpose.hpp"
#include "tests/reference/point_cloud.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace skein {
namespace {

template <class Real>
class PackTest : public ::testing::Test {};
using Reals = ::testing::Types<double, float>;
TYPED_TEST_SUITE(PackTest, Reals);

/// Largest |relative error| of inverse_sqrt_cubed over numbers of [10^low, 10^high), in units of the last place
/// (epsilon).
template <class Real>
double largest_error(const double low, const double high) {
  constexpr int width = simd::width<Real>;
  reference::Random random(11);
  long double largest = 0;
  for (int sample = 0; sample < 200000; ++sample) {
    alignas(simd::bytes) Real x[width], y[width];
    for (Real& lane : x) lane = static_cast<Real>(random.log_uniform(std::pow(10.0, low), std::pow(10.0, high)));
    simd::store_pack(y, simd::inverse_sqrt_cubed(simd::load_pack(x)));
    for (int lane = 0; lane < width; ++lane) {
      const long double exact = 1 / (static_cast<long double>(x[lane]) * std::sqrt(static_cast<long double>(x[lane])));
      const long double error = std::abs(y[lane] / exact - 1);
      if (!(error <= largest)) largest = error;
    }
  }
  return static_cast<double>(largest / std::numeric_limits<Real>::epsilon());
}

TEST(InverseSqrtCubed, IsGoodToTheLastBitsInDouble) { EXPECT_LT(largest_error<double>(-30.0, 30.0), 4.0); }

// Beyond, x^(-3/2) leaves the normal numbers of single precision.
TEST(InverseSqrtCubed, IsGoodToTheLastBitsInSingle) { EXPECT_LT(largest_error<float>(-25.0, 25.0), 4.0); }

TYPED_TEST(PackTest, EstimateIsAsGoodAsItSays) {
  using Real = TypeParam;
  const double bound = sizeof(Real) == sizeof(float) ? 8e-4 : 1.3e-4;
  reference::Random random(5);
  double worst = 0.0;
  for (int sample = 0; sample < 100000; ++sample) {
    const auto x = static_cast<Real>(random.log_uniform(1e-25, 1e25));
    const simd::Pack<Real> pack = simd::Pack<Real>{} + x;
    const double y = static_cast<double>(simd::estimate_inverse_sqrt(pack)[0]);
    worst = std::max(worst, std::abs(1.0 - static_cast<double>(x) * y * y));
  }
  EXPECT_LT(worst, bound);
  EXPECT_GT(worst, 0.0);  // an estimate that is exact everywhere was not measured
}

TYPED_TEST(PackTest, LanesDoNotMix) {
  using Real = TypeParam;
  constexpr int width = simd::width<Real>;
  alignas(simd::bytes) Real x[width], y[width];
  for (int lane = 0; lane < width; ++lane) x[lane] = static_cast<Real>(std::ldexp(1.0, 2 * lane - 6));
  simd::store_pack(y, simd::inverse_sqrt_cubed(simd::load_pack(x)));
  for (int lane = 0; lane < width; ++lane) {
    const double exact = std::ldexp(1.0, 9 - 3 * lane);
    EXPECT_NEAR(y[lane], exact, 4.0 * std::numeric_limits<Real>::epsilon() * exact) << "lane " << lane;
  }
}

TYPED_TEST(PackTest, LoadsAndStoresFromAnyAddress) {
  using Real = TypeParam;
  constexpr int width = simd::width<Real>;
  Real from[width + 1], to[width + 1] = {};
  for (int i = 0; i <= width; ++i) from[i] = static_cast<Real>(i) + Real(0.25);
  simd::store_pack(to + 1, simd::load_pack(from + 1));
  EXPECT_EQ(to[0], Real(0));
  for (int i = 1; i <= width; ++i) EXPECT_EQ(to[i], from[i]);
}

TYPED_TEST(PackTest, SumOfLanesIsTakenInDouble) {
  using Real = TypeParam;
  simd::Pack<Real> pack = {};
  double sum = 0.0;
  for (int lane = 0; lane < simd::width<Real>; ++lane) {
    pack[lane] = static_cast<Real>(lane == 0 ? 1 << 20 : std::ldexp(1.0, -lane));  // lost if added in single precision
    sum += static_cast<double>(pack[lane]);
  }
  EXPECT_EQ(simd::sum_lanes(pack), sum);
}

TYPED_TEST(PackTest, EachOfAsManyPacksAsLanesIsSummedIntoItsLane) {
  using Real = TypeParam;
  constexpr int width = simd::width<Real>;
  simd::Pack<Real> packs[width];
  for (int i = 0; i < width; ++i)
    for (int lane = 0; lane < width; ++lane) packs[i][lane] = static_cast<Real>(1 + i * i + 100 * i * lane);  // exact
  const simd::Pack<Real> sums = simd::sum_lanes_of_each<Real>(packs);
  for (int i = 0; i < width; ++i) EXPECT_EQ(sums[i], Real(width * (1 + i * i) + 50 * i * width * (width - 1))) << i;
}

TYPED_TEST(PackTest, LanesAreAddedInDouble) {
  using Real = TypeParam;
  constexpr int width = simd::width<Real>;
  alignas(simd::bytes) double to[width];
  simd::Pack<Real> pack;
  for (int lane = 0; lane < width; ++lane) {
    to[lane] = std::ldexp(1.0, 30) + lane;
    pack[lane] = static_cast<Real>(std::ldexp(3.0, -lane));
  }
  simd::add_lanes(to, pack);
  for (int lane = 0; lane < width; ++lane)
    EXPECT_EQ(to[lane], std::ldexp(1.0, 30) + lane + std::ldexp(3.0, -lane)) << lane;
}

TYPED_TEST(PackTest, NotANumberStaysOneInItsLaneAlone) {
  using Real = TypeParam;
  Real lanes[simd::width<Real>];
  for (int lane = 0; lane < simd::width<Real>; ++lane) lanes[lane] = Real(4);
  lanes[1] = std::numeric_limits<Real>::quiet_NaN();
  const simd::Pack<Real> x = simd::load_pack(lanes);
  const simd::Pack<Real> y = simd::inverse_sqrt_cubed(x);
  for (int lane = 0; lane < simd::width<Real>; ++lane) EXPECT_EQ(std::isnan(y[lane]), lane == 1) << "lane " << lane;
}

// The scalar form that GPUs use.
TYPED_TEST(PackTest, ScalarFormAgrees) {
  using Real = TypeParam;
  reference::Random random(3);
  for (int sample = 0; sample < 1000; ++sample) {
    const auto x = static_cast<Real>(random.log_uniform(1e-20, 1e20));
    const long double exact = 1 / std::sqrt(static_cast<long double>(x));
    EXPECT_LT(std::abs(math::inverse_sqrt_of_normal(x) / exact - 1), 2 * std::numeric_limits<Real>::epsilon());
  }
}

}  // namespace
}  // namespace skein
