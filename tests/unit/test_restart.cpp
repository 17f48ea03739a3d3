// Every integrator, stopped after any step, goes on from what it says is its memory as if nothing had happened.

#include <skein/dynamics/fiber_dynamics.hpp>
#include <skein/dynamics/make_integrator.hpp>
#include <skein/physics/fmm_mobility.hpp>
#include <skein/solvers/right_hand_side_decorator.hpp>

#include "runs/checkpoint_memory.hpp"
#include "tests/support/direct_physics.hpp"
#include "tests/unit/error_code.hpp"

#include <gtest/gtest.h>

#include <functional>
#include <memory>
#include <utility>
#include <vector>

namespace skein {
namespace {

SceneConfig make_scene(const int n_fibers, const std::function<void(TimeConfig&)>& choose) {
  SceneConfig scene;
  scene.fluid.viscosity = 1.3;
  scene.flows[0].rate = 2.1;
  scene.seed = 5;
  FiberConfig fiber;
  fiber.sections = 9;
  fiber.nodes_per_section = 5;
  fiber.blob = 0.004;
  for (int i = 0; i < n_fibers; ++i) {
    fiber.center = {0.001 * i, 0.02 * i, -0.013 * i};
    fiber.direction = {1.0, 0.3 + 0.1 * i, 0.2};
    scene.fibers.push_back(fiber);
  }
  choose(scene.time);
  return scene;
}

struct FiberRun {
  explicit FiberRun(const SceneConfig& scene, const FmmOptions* fmm = nullptr)
      : physics(make_some_physics(scene, fmm)),
        dynamics(physics),
        state{0.0, 0, to_device("position", make_surface_nodes(physics.fibers))},
        integrator(make_integrator(scene, physics, dynamics)),
        end(scene.time.end) {}

  static Physics make_some_physics(const SceneConfig& scene, const FmmOptions* fmm) {
    Physics physics = test::make_direct_physics(scene);
    if (fmm != nullptr) physics.mobility = std::make_unique<FmmMobility>(scene.fluid.viscosity, *fmm);
    return physics;
  }

  bool step() {
    if (state.time >= end) return false;
    integrator->advance(state, end);
    return true;
  }

  std::string save() {
    Checkpoint checkpoint;
    MemorySaver saver(checkpoint);
    visit_memory(saver, state);
    integrator->visit_memory(saver);
    dynamics.visit_memory(saver);
    return encode_checkpoint(checkpoint);
  }

  void restore(const std::string& bytes) {
    const Checkpoint checkpoint = decode_checkpoint(bytes);
    MemoryRestorer restorer(checkpoint);
    visit_memory(restorer, state);
    integrator->visit_memory(restorer);
    dynamics.visit_memory(restorer);
  }

  Physics physics;
  FiberDynamics dynamics;
  State state;
  std::unique_ptr<Integrator> integrator;
  double end;
};

/// @returns what the unbroken run knows of its errors at the end
ErrorRecord expect_exact_restarts(const SceneConfig& scene, const int min_steps, const FmmOptions* fmm = nullptr) {
  std::vector<std::string> saved;
  FiberRun unbroken(scene, fmm);
  saved.push_back(unbroken.save());
  while (unbroken.step()) saved.push_back(unbroken.save());
  EXPECT_GT(static_cast<int>(saved.size()), min_steps);
  // From every step to the next; then whatever follows is the same, too.
  for (std::size_t step = 0; step + 1 < saved.size(); ++step) {
    FiberRun resumed(scene, fmm);
    resumed.restore(saved[step]);
    EXPECT_TRUE(resumed.step());
    const bool is_same = resumed.save() == saved[step + 1];
    EXPECT_TRUE(is_same) << "after step " << step;
    if (!is_same) break;
  }
  // And all the way, once.
  FiberRun resumed(scene, fmm);
  resumed.restore(saved[saved.size() / 2]);
  while (resumed.step()) {
  }
  EXPECT_TRUE(resumed.save() == saved.back());
  return unbroken.physics.mobility->error_record();
}

/// Leaves so small that the few nodes of these scenes have a far field; with its operators cut far too short, so that a
/// check in the course of the run raises the order.
FmmOptions make_options_that_miss() {
  FmmOptions options;
  options.tolerance = 1e-2;
  options.order = 4;
  options.leaf_size = 3;
  options.singular_cutoff = 0.7;
  options.check_every = 301;
  return options;
}

TEST(Restart, OfRkc2IsExactAtEveryStep) {
  for (const int n_fibers : {1, 3})
    expect_exact_restarts(make_scene(n_fibers, [](TimeConfig& time) { time.end = 1.5, time.max_step = 0.02; }), 60);
}

TEST(Restart, OfRkc2WithAFixedStepIsExactAtEveryStep) {
  expect_exact_restarts(make_scene(1, [](TimeConfig& time) { time.end = 0.9, time.step = 0.0113; }), 60);
}

TEST(Restart, OfEulerIsExactAtEveryStep) {
  expect_exact_restarts(make_scene(1,
                                   [](TimeConfig& time) {
                                     time.method = TimeMethod::euler;
                                     time.step = 1.1e-4;
                                     time.end = 0.011;
                                   }),
                        90);
}

TEST(Restart, OfTheFastMultipoleMethodIsExactAtEveryStep) {
  const FmmOptions options = make_options_that_miss();
  for (const int n_fibers : {1, 3}) {
    const ErrorRecord errors = expect_exact_restarts(
        make_scene(n_fibers, [](TimeConfig& time) { time.end = 0.5, time.max_step = 0.02; }), 20, &options);
    EXPECT_GT(errors.n_checks, 1);
    EXPECT_GT(errors.n_misses, 0) << "the order was to be raised";
    EXPECT_GT(errors.order, options.order);
  }
}

TEST(Restart, OfEveryOtherMethodIsExactAtEveryStep) {
  for (const int n_fibers : {1, 2})
    for (const TimeMethod method : {TimeMethod::rk4, TimeMethod::bs3, TimeMethod::trbdf2, TimeMethod::automatic})
      expect_exact_restarts(make_scene(n_fibers,
                                       [&](TimeConfig& time) {
                                         time.method = method;
                                         const bool is_explicit =
                                             method == TimeMethod::rk4 || method == TimeMethod::bs3;
                                         time.end = is_explicit ? 0.03 : 0.8;
                                         time.max_step = is_explicit ? 4e-4 : 0.02;
                                       }),
                            30);
}

TEST(Restart, OfFibersThatRepelEachOtherIsExactAtEveryStep) {
  for (const TimeMethod method : {TimeMethod::rkc2, TimeMethod::trbdf2}) {
    SceneConfig scene =
        make_scene(3, [&](TimeConfig& time) { time.method = method, time.end = 0.6, time.max_step = 0.02; });
    scene.repulsion = {1.9, 0.02};
    FiberRun run(scene);
    std::vector<double> energy(3);
    ASSERT_EQ(run.physics.forces.size(), 2u);
    run.physics.forces[1]->add_energies(0.0, run.state.position, energy);
    EXPECT_GT(energy[1], 0.0);
    expect_exact_restarts(scene, 20);
  }
}

// What fibers do to each other is found anew in every evaluation, and rigid ones are put back in every step.
TEST(Restart, OfRigidFibersIsExactAtEveryStep) {
  for (const FiberModel last : {FiberModel::rigid, FiberModel::tube})
    for (const TimeMethod method : {TimeMethod::rkc2, TimeMethod::bs3, TimeMethod::automatic}) {
      SceneConfig scene =
          make_scene(3, [&](TimeConfig& time) { time.method = method, time.end = 0.3, time.max_step = 0.01; });
      for (FiberConfig& fiber : scene.fibers) fiber.model = FiberModel::rigid, fiber.sections = 12;
      scene.fibers.back().model = last;
      if (last == FiberModel::tube) scene.time.max_step = 1e-3, scene.time.end = 0.03;
      expect_exact_restarts(scene, 25);
    }
}

TEST(Restart, WithAnotherNumberOfNodesIsRefused) {
  FiberRun one(make_scene(1, [](TimeConfig&) {})), two(make_scene(2, [](TimeConfig&) {}));
  EXPECT_EQ(code_of([&] { two.restore(one.save()); }), ExitCode::damaged_data);
}

// The step after a break begins with a velocity of its own, also where a run goes on from there.
TEST(Restart, BesideBreaksIsExactWithEveryMethod) {
  for (const TimeMethod method :
       {TimeMethod::rkc2, TimeMethod::trbdf2, TimeMethod::rk4, TimeMethod::bs3, TimeMethod::euler}) {
    SCOPED_TRACE(static_cast<int>(method));
    SceneConfig scene = make_scene(1, [&](TimeConfig& time) {
      time.method = method, time.end = 0.12, time.max_step = 0.01;
      if (method == TimeMethod::euler) time.step = 2e-4;
    });
    FlowConfig pulse;
    pulse.start = 0.0301, pulse.stop = 0.0302;
    FlowConfig swing;
    swing.start = 0.02, swing.stop = 0.07, swing.ramp = 0.004, swing.angular_frequency = 50.0;
    scene.flows.insert(scene.flows.end(), {pulse, swing});
    expect_exact_restarts(scene, 20);
  }
}

// Leaves a step in the middle, at any of its evaluations.
class InterruptedDynamics final : public RightHandSideDecorator {
 public:
  struct Interrupted {};
  explicit InterruptedDynamics(RightHandSide& dynamics) : RightHandSideDecorator(dynamics) {}
  void compute_velocity(const double time, const ConstVectors& position, const Vectors& velocity) override {
    if (n_left-- == 0) throw Interrupted();
    inner_.compute_velocity(time, position, velocity);
  }
  int n_left = -1;  ///< evaluations until it happens; none for a negative number
};

TEST(Restart, OfAStepThatWasGivenUpIsExact) {
  const SceneConfig scenes[] = {
      make_scene(1, [](TimeConfig& time) { time.end = 1.0, time.max_step = 0.02; }),
      make_scene(1, [](TimeConfig& time) { time.method = TimeMethod::trbdf2, time.end = 1.0, time.max_step = 0.02; }),
      make_scene(1, [](TimeConfig& time) { time.method = TimeMethod::bs3, time.end = 0.1, time.max_step = 0.001; }),
      make_scene(1, [](TimeConfig& time) { time.method = TimeMethod::euler, time.step = 1e-4, time.end = 0.01; })};
  FmmOptions options = make_options_that_miss();
  options.check_every = 41;
  const std::pair<const SceneConfig&, const FmmOptions*> cases[] = {
      {scenes[0], nullptr}, {scenes[1], nullptr}, {scenes[2], nullptr}, {scenes[3], nullptr}, {scenes[0], &options}};
  for (const auto& [scene, fmm] : cases) {
    FiberRun unbroken(scene, fmm), broken(scene, fmm);
    InterruptedDynamics dynamics(broken.dynamics);
    broken.integrator = make_integrator(scene, broken.physics, dynamics);
    int n_interruptions = 0;
    for (int step = 0; step < 60 && unbroken.step(); ++step) {
      const std::string before = broken.save();
      dynamics.n_left = step % 7;
      try {
        broken.step();
      } catch (const InterruptedDynamics::Interrupted&) {
        ++n_interruptions;
        // Before the first step there is nothing in its arrays that counts.
        ASSERT_TRUE(step == 0 || broken.save() == before) << "step " << step;
        dynamics.n_left = -1;
        broken.step();
      }
      dynamics.n_left = -1;
      ASSERT_TRUE(broken.save() == unbroken.save()) << "step " << step;
    }
    EXPECT_GT(n_interruptions, 5);
  }
}

}  // namespace
}  // namespace skein
