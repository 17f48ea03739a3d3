// Runs past every limit of stability: each ends, and with finite positions or an error that says so.

#include <skein/core/error.hpp>
#include <skein/dynamics/make_integrator.hpp>
#include <skein/scene/words.hpp>

#include "tests/support/direct_physics.hpp"
#include "tests/support/paper_fiber.hpp"

#include <gtest/gtest.h>

#include <random>

namespace skein::test {
namespace {

/// A cheap fiber, its nodes moved at random by up to a third of the radius.
struct RandomRun {
  RandomRun(const TimeMethod method, const unsigned seed) {
    std::mt19937_64 random(seed);
    const auto draw = [&](const double low, const double high) {
      return low + (high - low) * (static_cast<double>(random() >> 11) * 0x1p-53);
    };
    FiberConfig fiber;
    fiber.sections = 10;
    fiber.nodes_per_section = 6;
    fiber.spring_stiffness *= std::pow(10.0, draw(-2.0, 2.0));
    fiber.blob *= draw(0.5, 2.0);
    fiber.direction = {1.0, draw(-1.0, 1.0), draw(-1.0, 1.0)};
    scene.fibers = {fiber};
    scene.time.method = method;
    scene.time.max_step = 10.0;
    scene.time.tolerance = std::pow(10.0, draw(-6.0, -0.5));
    // Some with a fixed step of any size; Euler always.
    if (method == TimeMethod::euler || draw(0.0, 1.0) < 0.5) scene.time.step = std::pow(10.0, draw(-4.0, 1.0));
    physics = std::make_unique<Physics>(test::make_direct_physics(scene));
    dynamics = std::make_unique<FiberDynamics>(*physics);
    std::vector<Vec3> nodes = make_surface_nodes(physics->fibers);
    const double size = draw(0.0, 0.33) * fiber.radius;
    for (Vec3& x : nodes) x = x + Vec3{draw(-size, size), draw(-size, size), draw(-size, size)};
    state.position = to_device("position", nodes);
  }

  SceneConfig scene;
  std::unique_ptr<Physics> physics;
  std::unique_ptr<FiberDynamics> dynamics;
  State state;
};

TEST(PastLimits, EveryRunEndsFiniteOrSaysWhatFailed) {
  int n_failed = 0, n_done = 0;
  for (const TimeMethod method : {TimeMethod::euler, TimeMethod::rk4, TimeMethod::bs3, TimeMethod::rkc2,
                                  TimeMethod::trbdf2, TimeMethod::automatic})
    for (unsigned seed = 0; seed < 17; ++seed) {
      RandomRun run(method, 100 + seed);
      std::vector<Vec3> last;
      try {
        const auto integrator = make_integrator(run.scene, *run.physics, *run.dynamics);
        for (int step = 0; step < 25; ++step) {
          last = to_host(ConstVectors(run.state.position));
          integrator->advance(run.state, 1e9);
          EXPECT_TRUE(run.dynamics->find_fault(run.state.position).empty()) << word_of(method) << ' ' << seed;
        }
        ++n_done;
      } catch (const Error& error) {
        EXPECT_EQ(error.code(), ExitCode::numerical) << word_of(method) << ' ' << seed << ": " << error.what();
        EXPECT_GT(std::string(error.what()).size(), 40u);
        EXPECT_EQ(to_host(ConstVectors(run.state.position)), last) << word_of(method) << ' ' << seed;
        ++n_failed;
      }
      EXPECT_LT(run.dynamics->evaluations(), 200000) << word_of(method) << ' ' << seed;
    }
  EXPECT_EQ(n_failed + n_done, 102);
  EXPECT_GT(n_failed, 20) << "limits were not passed";
  EXPECT_GT(n_done, 20);
}

}  // namespace
}  // namespace skein::test
