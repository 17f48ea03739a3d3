#include <skein/arrays/combination.hpp>
#include <skein/core/error.hpp>

#include "tests/reference/point_cloud.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <utility>

namespace skein {
namespace {

constexpr int sizes[] = {0, 1, 3, 255, 256, 257, 512, 1000};

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

}  // namespace
}  // namespace skein
