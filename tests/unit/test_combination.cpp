#include <skein/arrays/combination.hpp>
#include <skein/arrays/launch.hpp>
#include <skein/core/error.hpp>

#include "tests/reference/point_cloud.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <set>
#include <thread>
#include <utility>
#include <vector>

namespace skein {
namespace {

// Above 1000 nodes combinations are shared by threads, above 10 000 dot products.
constexpr int sizes[] = {0, 1, 3, 255, 256, 257, 512, 1000, 1001, 20000};

std::vector<Vec3> make_list(const int n, const std::uint64_t seed) {
  reference::Random random(seed);
  return reference::make_random_vectors(n, 3.0, random);
}

Vectors on_device(const std::vector<Vec3>& list) { return to_device("test::list", list); }

void expect_near(const std::vector<Vec3>& actual, const std::vector<Vec3>& expected) {
  ASSERT_EQ(actual.size(), expected.size());
  for (std::size_t i = 0; i < actual.size(); ++i) EXPECT_LT(norm(actual[i] - expected[i]), 1e-14) << "node " << i;
}

TEST(Combine, TwoTerms) {
  for (const int n : sizes) {
    const auto a = make_list(n, 1), b = make_list(n, 2);
    const Vectors result = on_device(make_list(n, 9));
    combine<ExecSpace>(ExecSpace(), result, {0.3, on_device(a)}, {-1.7, on_device(b)});
    std::vector<Vec3> expected;
    for (int i = 0; i < n; ++i) expected.push_back(0.3 * a[i] + -1.7 * b[i]);
    expect_near(to_host(result), expected);
  }
}

TEST(Combine, FourTerms) {
  for (const int n : sizes) {
    const auto a = make_list(n, 1), b = make_list(n, 2), c = make_list(n, 3), d = make_list(n, 4);
    const Vectors result = on_device(make_list(n, 9));
    combine<ExecSpace>(ExecSpace(), result, {0.3, on_device(a)}, {-1.7, on_device(b)}, {2.1, on_device(c)},
                       {0.05, on_device(d)});
    std::vector<Vec3> expected;
    for (int i = 0; i < n; ++i) expected.push_back(0.3 * a[i] + -1.7 * b[i] + 2.1 * c[i] + 0.05 * d[i]);
    expect_near(to_host(result), expected);
  }
}

TEST(Combine, FiveTerms) {
  for (const int n : sizes) {
    const auto a = make_list(n, 1), b = make_list(n, 2), c = make_list(n, 3), d = make_list(n, 4), e = make_list(n, 5);
    const Vectors result = on_device(make_list(n, 9));
    combine<ExecSpace>(ExecSpace(), result, {0.3, on_device(a)}, {-1.7, on_device(b)}, {2.1, on_device(c)},
                       {0.05, on_device(d)}, {-0.9, on_device(e)});
    std::vector<Vec3> expected;
    for (int i = 0; i < n; ++i) expected.push_back(0.3 * a[i] + -1.7 * b[i] + 2.1 * c[i] + 0.05 * d[i] + -0.9 * e[i]);
    expect_near(to_host(result), expected);
  }
}

TEST(Combine, ResultMayBeATerm) {
  const auto a = make_list(300, 1), b = make_list(300, 2);
  for (const bool result_first : {true, false}) {
    const Vectors result = on_device(a);
    if (result_first)
      combine<ExecSpace>(ExecSpace(), result, {0.3, result}, {-1.7, on_device(b)});
    else
      combine<ExecSpace>(ExecSpace(), result, {-1.7, on_device(b)}, {0.3, result});
    std::vector<Vec3> expected;
    for (std::size_t i = 0; i < a.size(); ++i) expected.push_back(0.3 * a[i] + -1.7 * b[i]);
    expect_near(to_host(result), expected);
  }
}

TEST(Combine, RefusesArraysOfDifferentLengths) {
  const Vectors ten = on_device(make_list(10, 1)), nine = on_device(make_list(9, 1));
  const ExecSpace space;
  EXPECT_THROW(combine<ExecSpace>(space, nine, {0.3, ten}, {0.2, ten}), Error);
  EXPECT_THROW(combine<ExecSpace>(space, ten, {0.3, ten}, {0.2, nine}), Error);
  EXPECT_THROW(combine<ExecSpace>(space, ten, {0.3, ten}, {0.2, ten}, {0.2, nine}, {0.2, ten}), Error);
  EXPECT_THROW(combine<ExecSpace>(space, ten, {0.3, ten}, {0.2, ten}, {0.2, ten}, {0.2, ten}, {0.7, nine}), Error);
}

TEST(DotProduct, AgreesWithASumInLongDouble) {
  for (const int n : sizes) {
    const auto a = make_list(n, 1), b = make_list(n, 2);
    long double exact = 0, size = 0;
    for (int i = 0; i < n; ++i)
      for (const auto component : {&Vec3::x, &Vec3::y, &Vec3::z}) {
        const long double product = static_cast<long double>(a[i].*component) * b[i].*component;
        exact += product;
        size += std::abs(product);
      }
    EXPECT_NEAR(dot_product<ExecSpace>(ExecSpace(), on_device(a), on_device(b)), static_cast<double>(exact),
                1e-14 * static_cast<double>(size))
        << n;
  }
}

TEST(DotProduct, NotANumberIsNotLost) {
  auto a = make_list(600, 1);
  a[599].z = std::nan("");
  EXPECT_TRUE(std::isnan(dot_product<ExecSpace>(ExecSpace(), on_device(a), on_device(make_list(600, 2)))));
}

TEST(DotProduct, RefusesArraysOfDifferentLengths) {
  EXPECT_THROW(dot_product<ExecSpace>(ExecSpace(), on_device(make_list(10, 1)), on_device(make_list(9, 1))), Error);
}

// Their components are apart from each other, which a copy from a device's memory has to know.
TEST(ToHost, TakesSomeNodesOfAnArray) {
  const auto list = make_list(600, 3);
  const auto some = to_host(Kokkos::subview(on_device(list), std::make_pair(17, 23), Kokkos::ALL()));
  ASSERT_EQ(some.size(), 6U);
  for (std::size_t i = 0; i < some.size(); ++i) EXPECT_EQ(norm(some[i] - list[i + 17]), 0.0) << i;
  EXPECT_TRUE(to_host(Kokkos::subview(on_device(list), std::make_pair(4, 4), Kokkos::ALL())).empty());
}

/// Calls kernels of so many nanoseconds. @returns how many threads took part
std::size_t count_threads(const int n_calls, const double nanoseconds) {
  std::vector<std::thread::id> thread(static_cast<std::size_t>(n_calls));
  std::vector<std::atomic<int>> n_times(thread.size());
  launch<HostSpace>("skein::test::launch", HostSpace(), Calls{n_calls, nanoseconds}, [&](const int i) {
    thread[static_cast<std::size_t>(i)] = std::this_thread::get_id();
    ++n_times[static_cast<std::size_t>(i)];
  });
  EXPECT_TRUE(std::all_of(n_times.begin(), n_times.end(), [](const auto& n) { return n == 1; })) << n_calls << " calls";
  int smallest = 0, count = 0;
  launch_reduction<HostSpace>(
      "skein::test::launch", HostSpace(), Calls{n_calls, nanoseconds},
      [&](const int i, int& least, int& sum) {
        least = std::min(least, (i * 7) % n_calls - 3);
        ++sum;
      },
      Kokkos::Min<int>(smallest), Kokkos::Sum<int>(count));
  EXPECT_EQ(smallest, -3);
  EXPECT_EQ(count, n_calls);
  return std::set<std::thread::id>(thread.begin(), thread.end()).size();
}

// What is short is not shared by threads, and nothing is left out or done twice.
TEST(Launch, SharesWhatIsLongAndCallsEachOnce) {
  if (HostSpace().concurrency() < 2) GTEST_SKIP() << "needs two threads";
  EXPECT_EQ(count_threads(1000, 9.9), 1u);
  EXPECT_GT(count_threads(1000, 10.1), 1u);
  EXPECT_EQ(count_threads(3, 3.3e3), 1u);
  EXPECT_GT(count_threads(2, 5.1e3), 1u);
}

}  // namespace
}  // namespace skein
