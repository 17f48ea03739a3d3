// What a sum by the fast multipole method launches and waits for on a device: below a million nodes that is most of
// what a new tree takes.
#include <skein/fibers/fiber.hpp>
#include <skein/physics/fmm_mobility.hpp>

#include "tests/reference/point_cloud.hpp"
#include "tests/support/launch_counts.hpp"

#include <gtest/gtest.h>

namespace skein {
namespace {

using test::Counting;
using test::Launches;

/// The nodes of a straight tube, summed as on a device.
class TubeSum {
 public:
  explicit TubeSum(const int sections) : mobility_(1.0, options()) {
    mobility_.time_parts(false);
    FiberConfig config;
    config.sections = sections;
    const auto fiber = make_fibers({config});
    const auto nodes = make_surface_nodes(fiber);
    reference::Random random(5);
    const auto force = reference::make_random_vectors(static_cast<int>(nodes.size()), 1.0, random);
    sources_ = {to_device("position", nodes), to_device("force", force), to_device("blob", make_blobs(fiber))};
    velocity_ = Vectors("velocity", nodes.size());
  }

  void add() { mobility_.add_velocity(sources_, sources_.position, velocity_); }
  Launches count() {
    const Counting counting;
    add();
    return counting.so_far();
  }
  FmmMobility& mobility() { return mobility_; }

 private:
  static FmmOptions options() {
    FmmOptions options;
    options.tolerance = 1e-4;
    options.path = KernelPath::device;
    options.direct_when_cheaper = false;
    options.check_every = 0;
    return options;
  }

  FmmMobility mobility_;
  Sources sources_;
  Vectors velocity_;
};

/// Deep enough for far pairs, and ten times as many nodes.
constexpr int few_sections = 300, many_sections = 3000;

// A sample of the nodes, boxes, lists: each is waited for once, however many levels there are. Of the reductions, the
// census of the nodes is waited for, and on hosts and for many keys the three looks whether keys are sorted already;
// transfers, leaves and near pairs are left for the wait that lists have.
TEST(FmmLaunches, OfANewTreeAreFewWaitsWhateverItsDepth) {
  int n_levels = 0;
  for (const int sections : {few_sections, many_sections}) {
    TubeSum sum(sections);
    sum.add();
    const Launches made = sum.count();
    const int levels = sum.mobility().statistics().n_levels;
    EXPECT_EQ(made.waits, 3) << sections;
    EXPECT_EQ(made.fences, 0) << sections;
    EXPECT_EQ(made.reductions, 7) << sections;
    EXPECT_LE(made.kernels, 30 + 5 * levels) << sections;
    EXPECT_GT(levels, n_levels);
    n_levels = levels;
    EXPECT_EQ(sum.mobility().statistics().n_trees, 2);
  }
}

// The count of nodes outside of their leaves is waited for together with the census.
TEST(FmmLaunches, OfATreeThatIsKeptIsOneWait) {
  for (const int sections : {few_sections, many_sections}) {
    TubeSum sum(sections);
    sum.mobility().begin_step();
    sum.add();
    const Launches kept = sum.count();
    EXPECT_EQ(sum.mobility().statistics().n_trees, 1);
    EXPECT_EQ(kept.waits, 0) << sections;
    EXPECT_EQ(kept.fences, 0) << sections;
    EXPECT_EQ(kept.reductions, 2) << sections;
    EXPECT_LE(kept.kernels, 16 + 2 * sum.mobility().statistics().n_levels) << sections;
  }
}

// Else seconds of the parts would be those of their launches.
TEST(FmmLaunches, AreWaitedForWhereTheirTimeIsAsked) {
  TubeSum sum(few_sections);
  sum.mobility().time_parts();
  sum.mobility().begin_step();
  sum.add();
  EXPECT_GE(sum.count().waits, 4) << "tree, nodes, passes, leaves, and those of the tail";
  EXPECT_GT(sum.mobility().statistics().leaf_seconds, 0.0);
}

}  // namespace
}  // namespace skein
