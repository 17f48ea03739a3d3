#include "fmm/node_places.hpp"

#include <gtest/gtest.h>

#include <random>
#include <vector>

// Places of nodes of which a rank has some, against a list of all.

namespace skein {
namespace {

TEST(NodePlaces, AreInTheOrderOfAllAndEachOnce) {
  std::mt19937 random(3);
  const auto draw = [&](const int n) { return std::uniform_int_distribution<int>(0, n - 1)(random); };
  for (int trial = 0; trial < 300; ++trial) {
    constexpr int n_all = 60;
    std::vector<IndexRange> runs;
    std::vector<int> here(n_all, -1);
    for (int k = draw(9); k > 0; --k) {
      const int first = draw(n_all);
      runs.push_back({first, draw(n_all - first + 1)});
      for (int i = first; i < first + runs.back().count; ++i) here[static_cast<std::size_t>(i)] = 0;
    }
    int n_places = 1;
    for (int& place : here)
      if (place == 0) place = n_places++;
    const NodePlaces places(runs);
    ASSERT_EQ(places.n_places(), n_places);
    for (int first = 0; first < n_all; ++first)
      for (int count = 1; first + count <= n_all; ++count) {
        bool is_here = true;
        for (int i = first; i < first + count; ++i) is_here = is_here && here[static_cast<std::size_t>(i)] > 0;
        const IndexRange found = places.find({first, count});
        ASSERT_EQ(found.count, count);
        ASSERT_EQ(found.first, is_here ? here[static_cast<std::size_t>(first)] : 0) << first << " " << count;
      }
    const int first = draw(n_all), count = draw(n_all - first + 1);
    std::vector<int> between(n_all, 0);
    int end = -1;
    for (const IndexRange& run : places.list_between({first, count})) {
      ASSERT_GT(run.first, end) << "in order, and joined where they follow each other";
      end = run.first + run.count;
      for (int i = run.first; i < end; ++i) ++between[static_cast<std::size_t>(i)];
    }
    for (int i = 0; i < n_all; ++i)
      ASSERT_EQ(between[static_cast<std::size_t>(i)],
                i >= first && i < first + count && here[static_cast<std::size_t>(i)] > 0 ? 1 : 0);
  }
}

TEST(NodePlaces, HaveOneThatIsNobodys) {
  EXPECT_EQ(NodePlaces().n_places(), 1);
  EXPECT_EQ(NodePlaces({{0, 0}, {5, 0}}).n_places(), 1);
  EXPECT_EQ(NodePlaces({{5, 2}}).find({5, 1}).first, 1);
}

}  // namespace
}  // namespace skein
