#include "runs/simulate.hpp"

#include <skein/dynamics/make_integrator.hpp>

#include "runs/checkpoint_memory.hpp"
#include "runs/evaluation_time.hpp"
#include "runs/fault_injection.hpp"
#include "runs/run_description.hpp"
#include "runs/simulation.hpp"

#include <optional>

namespace skein {
namespace {

/// Open MPI's mpirun kills what is left a second after it has passed SIGTERM on, unless it is told another time.
constexpr double patience_of_launchers = 0.3;  // seconds

}  // namespace

ExitCode simulate(const SceneConfig& scene, const RunFolder& folder, const Checkpoint* checkpoint, RunControl& control,
                  RunListener& listener, const std::string& first_words, Communicator* ranks) {
  std::optional<SumTeam> team;
  if (ranks != nullptr) {
    team.emplace(*ranks);
    control.set_patience(patience_of_launchers);
  }
  Simulation simulation(scene, folder, checkpoint, control, listener, read_fault_hooks(), team ? &*team : nullptr);
  if (!first_words.empty()) simulation.say(first_words);
  simulation.introduce();
  return simulation.run();
}

std::string describe_dry_run(const SceneConfig& scene) {
  Physics physics = make_physics(scene);
  FiberDynamics dynamics(physics);
  const auto integrator = make_integrator(scene, physics, dynamics);
  const Vectors position = to_device("skein::describe_dry_run", physics.make_start_nodes(scene.seed));
  State state{scene.time.start, 0, position};
  MemorySize size;
  visit_memory(size, state);
  integrator->visit_memory(size);
  Prospect prospect;
  prospect.cost = time_evaluation(dynamics, position);
  prospect.spectral_radius = find_spectral_radius(scene, dynamics, scene.time.start, position);
  prospect.step = integrator->expect_step(prospect.spectral_radius);
  prospect.checkpoint_bytes = size.bytes();
  return describe_run(scene, physics.fibers, physics.describe_forces(), integrator->describe(), prospect);
}

}  // namespace skein
