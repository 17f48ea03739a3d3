#include "kernels/node_checks.hpp"
#include "tests/reference/point_cloud.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <string>
#include <vector>

// The census of nodes against a loop over all of them.

namespace skein {
namespace {

using reference::Cloud;
using reference::Random;

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();

double component(const Vec3& x, const int c) { return c == 0 ? x.x : c == 1 ? x.y : x.z; }

NodeCensus census_of(const std::vector<Vec3>& source, const std::vector<Vec3>& target,
                     const std::vector<double>& blob) {
  const ConstVectors at = to_device("source", source);
  const ConstVectors other = target.empty() ? at : ConstVectors(to_device("target", target));
  return take_census<ExecSpace>(ExecSpace(), at, other, to_device("blob", blob));
}

void expect_bounds(const NodeCensus& census, const std::vector<Vec3>& source, const std::vector<Vec3>& target) {
  std::vector<Vec3> all = source;
  all.insert(all.end(), target.begin(), target.end());
  for (int c = 0; c < 3; ++c) {
    const auto less = [c](const Vec3& a, const Vec3& b) { return component(a, c) < component(b, c); };
    const auto [low, high] = std::minmax_element(all.begin(), all.end(), less);
    EXPECT_EQ(census.bounds.low[c], component(*low, c));
    EXPECT_EQ(census.bounds.high[c], component(*high, c));
  }
}

TEST(NodeCensus, FindsExtremesWhereverTheyAre) {
  Random random(3);
  for (const int n : {1, 15, 16, 17, 2047, 2048, 2049, 70001})
    for (const int n_targets : {0, 1, 3000}) {
      SCOPED_TRACE(std::to_string(n) + " sources, " + std::to_string(n_targets) + " targets");
      const auto source = reference::make_cloud(Cloud::cube, n, {-3.0, 1e4, 0.2}, 0.8, random);
      auto target = reference::make_cloud(Cloud::cluster, n_targets, {-3.0, 1e4, 0.2}, 0.9, random);
      std::vector<double> blob(static_cast<std::size_t>(n), 0.3);
      blob.back() = 0.2;
      blob[blob.size() / 2] = n > 1 ? 0.7 : 0.2;
      const NodeCensus census = census_of(source, target, blob);
      expect_bounds(census, source, target);
      EXPECT_EQ(census.blobs.smallest, 0.2);
      EXPECT_EQ(census.blobs.largest, n > 1 ? 0.7 : 0.2);
      EXPECT_TRUE(census.are_finite);
    }
}

TEST(NodeCensus, SeesEachNumberThatIsNotFinite) {
  Random random(4);
  const auto good = reference::make_cloud(Cloud::cube, 5000, {}, 1.0, random);
  const std::vector<double> blob(good.size(), 1.0);
  for (const std::size_t node : {0, 16, 2047, 2048, 4999})
    for (const double bad : {infinity, -infinity, not_a_number})
      for (int c = 0; c < 3; ++c) {
        auto nodes = good;
        (c == 0 ? nodes[node].x : c == 1 ? nodes[node].y : nodes[node].z) = bad;
        EXPECT_FALSE(census_of(nodes, {}, blob).are_finite) << node << ", axis " << c;
        EXPECT_FALSE(census_of(good, nodes, blob).are_finite) << "target " << node << ", axis " << c;
      }
  EXPECT_TRUE(census_of(good, {}, blob).are_finite);
}

TEST(NodeCensus, OfBlobsAlone) {
  const BlobRange range =
      find_blob_range<ExecSpace>(ExecSpace(), to_device("blob", std::vector<double>{0.4, 0.1, 0.3}));
  EXPECT_EQ(range.smallest, 0.1);
  EXPECT_EQ(range.largest, 0.4);
}

// A box that no node has widened.
TEST(NodeCensus, OfNoNodes) {
  const NodeCensus census = census_of({}, {}, {});
  EXPECT_TRUE(census.are_finite);
  for (int c = 0; c < 3; ++c) EXPECT_GT(census.bounds.low[c], census.bounds.high[c]);
}

}  // namespace
}  // namespace skein
