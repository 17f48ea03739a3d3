// Forward Euler's limit for the paper's fiber: 2 over the spectral radius of the spring-mobility operator, where
// sections ovalize with alternating sign.

#include <skein/core/error.hpp>
#include <skein/solvers/euler.hpp>
#include <skein/solvers/spectral_radius.hpp>

#include "tests/support/paper_fiber.hpp"

#include <gtest/gtest.h>

#include <utility>

namespace skein::test {
namespace {

TEST(SpectralRadius, IsElevenThousandAtEveryLength) {
  for (const int sections : {40, 80, 113}) {
    PaperFiber fiber(sections);
    const Vectors velocity("velocity", fiber.state.position.extent(0));
    fiber.dynamics.compute_velocity(0.0, fiber.state.position, velocity);
    SpectralRadius power_iteration(fiber.n_nodes(), 1e-8, 1);
    const double radius = power_iteration.estimate(fiber.dynamics, 0.0, fiber.state.position, velocity, 1e-4, 300);
    EXPECT_NEAR(radius, 1.1e4, 0.03 * 1.1e4) << sections << " sections";
  }
}

// 1.81e-4, and 1.53e-4 with half the blob: tests/reference/decay_rates.py.
TEST(SpectralRadius, GivesEulersLimit) {
  for (const auto& [blob_ratio, limit] : {std::pair{1.0, 1.81e-4}, std::pair{0.5, 1.53e-4}}) {
    PaperFiber fiber(80, blob_ratio);
    const Vectors velocity("velocity", fiber.state.position.extent(0));
    fiber.dynamics.compute_velocity(0.0, fiber.state.position, velocity);
    SpectralRadius power_iteration(fiber.n_nodes(), 1e-8, 1);
    const double radius = power_iteration.estimate(fiber.dynamics, 0.0, fiber.state.position, velocity, 1e-4, 300);
    EXPECT_NEAR(2.0 / radius, limit, 0.03 * limit) << "blob times " << blob_ratio;
  }
}

TEST(Euler, IsStableBelowItsLimit) {
  PaperFiber fiber(80);
  Euler euler(fiber.dynamics, 1.75e-4, fiber.length(), fiber.n_nodes());
  for (int step = 0; step < 3000; ++step) ASSERT_NO_THROW(euler.advance(fiber.state, 100.0)) << "step " << step;
  // The fiber is about as long as it was (shear compresses it a little): an unstable mode would have grown by 1e100.
  EXPECT_NEAR(norm(fiber.end_to_end(fiber.state.position)), 79.0 / 80.0 * fiber.length(), 5e-3 * fiber.length());
}

TEST(Euler, IsCaughtBlowingUpAboveItsLimit) {
  PaperFiber fiber(80);
  Euler euler(fiber.dynamics, 1.9e-4, fiber.length(), fiber.n_nodes());
  std::vector<Vec3> last_good;
  try {
    for (int step = 0; step < 3000; ++step) {
      last_good = to_host(fiber.state.position);
      euler.advance(fiber.state, 100.0);
    }
    FAIL() << "3000 steps above the stability limit went unnoticed";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ExitCode::numerical);
    const std::string message = error.what();
    EXPECT_NE(message.find("node "), std::string::npos) << message;
    EXPECT_NE(message.find("Forward Euler is stable below dt = 2 / spectral radius = 0.00018"), std::string::npos)
        << message;
  }
  // What is left is the last good state, not the broken one.
  EXPECT_EQ(to_host(fiber.state.position), last_good);
  EXPECT_TRUE(fiber.dynamics.find_fault(fiber.state.position).empty());
}

}  // namespace
}  // namespace skein::test
