#include <skein/core/counter_random.hpp>

#include <gtest/gtest.h>

#include <cmath>

namespace skein {
namespace {

using Words = std::array<std::uint32_t, 4>;

TEST(CounterRandom, PhiloxGivesItsKnownAnswers) {
  EXPECT_EQ(philox({0, 0, 0, 0}, {0, 0}), (Words{0x6627e8d5, 0xe169c58d, 0xbc57ac4c, 0x9b00dbd8}));
  EXPECT_EQ(philox({~0u, ~0u, ~0u, ~0u}, {~0u, ~0u}), (Words{0x408f276d, 0x41c83b0e, 0xa20bc7c6, 0x6d5451fd}));
  EXPECT_EQ(philox({0x243f6a88, 0x85a308d3, 0x13198a2e, 0x03707344}, {0xa4093822, 0x299f31d0}),
            (Words{0xd16cfe09, 0x94fdcceb, 0x5001e420, 0x24126ea1}));
}

TEST(CounterRandom, EveryPartOfTheNameCounts) {
  using Purpose = CounterRandom::Purpose;
  const auto reference = CounterRandom(7, Purpose::placement, 3).draw(5);
  EXPECT_EQ(CounterRandom(7, Purpose::placement, 3).draw(5), reference);
  EXPECT_NE(CounterRandom(8, Purpose::placement, 3).draw(5), reference);
  EXPECT_NE(CounterRandom(7 + (1ull << 32), Purpose::placement, 3).draw(5), reference);
  EXPECT_NE(CounterRandom(7, Purpose::start_noise, 3).draw(5), reference);
  EXPECT_NE(CounterRandom(7, Purpose::placement, 4).draw(5), reference);
  EXPECT_NE(CounterRandom(7, Purpose::placement, 3).draw(6), reference);
}

TEST(CounterRandom, NumbersAreEvenBetweenZeroAndOne) {
  const CounterRandom random(11, CounterRandom::Purpose::placement, 0);
  constexpr int n = 20000;
  double sum[2] = {}, squares[2] = {}, product = 0.0;
  for (int i = 0; i < n; ++i) {
    const auto [a, b] = random.draw(i);
    ASSERT_TRUE(a >= 0.0 && a < 1.0 && b >= 0.0 && b < 1.0);
    sum[0] += a, sum[1] += b, squares[0] += a * a, squares[1] += b * b, product += a * b;
  }
  const double tolerance = 4.0 / std::sqrt(n);
  for (int k = 0; k < 2; ++k) {
    EXPECT_NEAR(sum[k] / n, 0.5, 0.29 * tolerance);
    EXPECT_NEAR(squares[k] / n, 1.0 / 3.0, 0.3 * tolerance);
  }
  EXPECT_NEAR(product / n, 0.25, 0.23 * tolerance);
}

}  // namespace
}  // namespace skein
