// What is chosen for a device, against what was measured on one. No device is needed: choices are arithmetic.
#include <skein/core/error.hpp>
#include <skein/fmm/fmm_cost.hpp>
#include <skein/fmm/fmm_sum.hpp>
#include <skein/fmm/machine_rates.hpp>
#include <skein/physics/mobility_choice.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

namespace skein {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

/// Milliseconds of one sum over a straight fiber of the paper's on an H100, 27 November 2026; the fast multipole method
/// with a tree that is kept, as nearly all sums of a step have it.
struct Measured {
  int sections;
  double tolerance;
  double direct_in_double, direct_in_single, fmm;  ///< infinite where the tolerance bars it, or nobody looked
};

SceneConfig make_scene(const int sections, const double tolerance) {
  SceneConfig scene;
  FiberConfig fiber;
  fiber.sections = sections;
  scene.fibers = {fiber};
  scene.hydrodynamics.tolerance = tolerance;
  return scene;
}

double time_of(const MobilityChoice& choice, const Measured& measured) {
  if (!choice.is_direct) return measured.fmm;
  return choice.precision == Precision::in_single ? measured.direct_in_single : measured.direct_in_double;
}

TEST(MachineRates, ChoicesForADeviceAreWithinAThirdOfTheBestMeasured) {
  for (const Measured& measured :
       {Measured{80, 1e-4, 0.0137, 0.0122, infinity}, Measured{80, 1e-8, 0.0137, infinity, infinity},
        Measured{301, 1e-3, 0.0684, 0.0411, infinity}, Measured{301, 1e-4, 0.0684, 0.0411, infinity},
        Measured{301, 1e-7, 0.0684, infinity, infinity}, Measured{1313, 1e-4, 1.12, 0.556, 0.345},
        Measured{1313, 1e-6, 1.12, 0.556, 0.570}, Measured{5252, 1e-4, 16.3, 8.2, 0.551},
        Measured{5252, 1e-6, 16.3, 8.2, 0.916}}) {
    const MobilityChoice choice =
        choose_mobility(make_scene(measured.sections, measured.tolerance), KernelPath::device);
    const double best = std::min({measured.direct_in_double, measured.direct_in_single, measured.fmm});
    EXPECT_LE(time_of(choice, measured), 1.3 * best)
        << measured.sections << " sections at " << measured.tolerance << ": " << choice.reason;
  }
}

TEST(MachineRates, DirectSumsOfHostsThatAreChosenAreExact) {
  for (const int sections : {10, 80, 301}) {
    const MobilityChoice choice = choose_mobility(make_scene(sections, 1e-3), KernelPath::host);
    EXPECT_EQ(choice.is_direct, 18 * sections < 1500);
    EXPECT_NE(choice.precision, Precision::in_single);
  }
}

TEST(MachineRates, PrecisionThatASceneAsksForStays) {
  SceneConfig scene = make_scene(301, 1e-4);
  scene.hydrodynamics.precision = Precision::in_double;
  EXPECT_EQ(choose_mobility(scene, KernelPath::device).precision, Precision::in_double);
  scene = make_scene(20, 1e-9);
  scene.hydrodynamics.precision = Precision::in_single;
  EXPECT_EQ(choose_mobility(scene, KernelPath::device).precision, Precision::in_single);
}

// Counts of trees of 1e5 and 1e6 nodes in a cube at 1e-4; the sums took 1.54 and 11.5 ms, direct ones in single 9.2 and
// 920.
TEST(MachineRates, TreesOfCubesAreCheaperOnADeviceByWhatWasMeasured) {
  FmmOptions options;
  options.path = KernelPath::device;
  const FmmPlan plan = choose_fmm_plan(options, 1e-4, 0);
  const double of_1e5 = estimate_relative_cost({1e5, 1e5, 5833e5, 32136, 585}, plan, false, options);
  const double of_1e6 = estimate_relative_cost({1e6, 1e6, 5797e6, 640584, 4681}, plan, false, options);
  EXPECT_NEAR(of_1e5 * 9.3, 1.54, 0.5);
  EXPECT_NEAR(of_1e6 * 930.0, 11.5, 2.0);
}

TEST(MachineRates, LeavesOfADeviceAreLarger) {
  FmmOptions options;
  options.path = KernelPath::host;
  EXPECT_EQ(choose_fmm_plan(options, 1e-4, 0).leaf_size, 64);
  options.path = KernelPath::device;
  EXPECT_EQ(choose_fmm_plan(options, 1e-4, 0).leaf_size, 128);
  options.leaf_size = 40;
  EXPECT_EQ(choose_fmm_plan(options, 1e-4, 0).leaf_size, 40);
}

TEST(DeviceSums, AreNotInAProgramForHostsThatDoesNotAskForThem) {
  if (on_host<ExecSpace>)
    EXPECT_THROW(make_fmm_sum(KernelPath::device), Error);
  else
    EXPECT_NE(make_fmm_sum(KernelPath::automatic), nullptr);
}

}  // namespace
}  // namespace skein
