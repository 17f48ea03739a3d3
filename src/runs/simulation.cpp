#include "runs/simulation.hpp"

#include <skein/arrays/memory_snapshot.hpp>
#include <skein/arrays/runtime.hpp>
#include <skein/core/milestone.hpp>
#include <skein/dynamics/make_integrator.hpp>
#include <skein/io/trajectory_end.hpp>
#include <skein/physics/scene_times.hpp>
#include <skein/ranks/rank_error.hpp>
#include <skein/scene/recorded_times.hpp>

#include "runs/evaluation_time.hpp"
#include "runs/run_description.hpp"
#include "runs/shared_run.hpp"
#include "runs/start_state.hpp"

#include <fmt/format.h>

#include <cmath>
#include <limits>

namespace skein {
namespace {

/// On a device, timing the parts of a step waits in each evaluation: one step in many stands for the others.
constexpr int steps_per_timing = on_host<ExecSpace> ? 1 : 16;

TrajectoryEnd find_start(const RunFolder& folder, const Checkpoint* checkpoint) {
  return checkpoint == nullptr ? find_trajectory_start(folder) : read_trajectory_end(*checkpoint);
}

/// The physics of a run, after the hooks have seen it.
Physics make_prepared_physics(const SceneConfig& scene, const RunHooks& hooks, const State& state, SumTeam* team) {
  Physics physics = make_physics(scene, team);
  if (hooks.prepare) hooks.prepare(physics, state);
  return physics;
}

std::unique_ptr<RightHandSide> decorate(const RunHooks& hooks, RightHandSide& dynamics, const State& state) {
  return hooks.decorate ? hooks.decorate(dynamics, state) : nullptr;
}

}  // namespace

Simulation::Simulation(const SceneConfig& scene, const RunFolder& folder, const Checkpoint* checkpoint,
                       RunControl& control, RunListener& listener, const RunHooks& hooks, SumTeam* team)
    : scene_(resolve_times(scene)),
      folder_(folder),
      control_(control),
      team_(team),
      messages_(folder, listener),
      physics_(make_prepared_physics(scene, hooks, state_, team)),
      state_(make_start_state(scene, folder, checkpoint != nullptr, physics_)),
      dynamics_(physics_),
      decorator_(decorate(hooks, dynamics_, state_)),
      watched_dynamics_(decorator_ == nullptr ? static_cast<RightHandSide&>(dynamics_) : *decorator_, control),
      integrator_(make_integrator(scene_, physics_, watched_dynamics_)),
      ledger_(dynamics_),
      recorder_(scene_, folder, physics_, find_start(folder, checkpoint), ledger_, messages_),
      checkpoints_(scene_, folder, {state_, *integrator_, dynamics_, ledger_, recorder_}, control, messages_) {
  control_.watch(folder);
  if (checkpoint != nullptr) checkpoints_.restore(*checkpoint);
  ledger_.begin(state_.step);
  listener.begin(state_.time, scene.time.end, ledger_.evaluations());
}

void Simulation::introduce() {
  // Evaluations that only measure their cost leave no trace.
  MemorySnapshot before;
  before.take(dynamics_);
  Prospect prospect;
  EvaluationCost& cost = prospect.cost;
  prospect.spectral_radius = std::numeric_limits<double>::quiet_NaN();
  prospect.checkpoint_bytes = checkpoints_.checkpoint_bytes();
  try {
    cost = time_evaluation(dynamics_, state_.position);
    ledger_.parts().direct_sums_each = cost.direct_seconds;
    prospect.spectral_radius = find_spectral_radius(scene_, dynamics_, state_.time, state_.position);
  } catch (const Error& error) {  // the first step meets it, too, and there is a checkpoint then
    if (error.code() != ExitCode::numerical) throw;
  }
  before.bring_back(dynamics_);
  physics_.mobility->take_messages();
  ledger_.exclude_evaluations();
  if (team_ != nullptr) cost.direct_seconds /= team_->ranks().size();
  prospect.step = integrator_->expect_step(prospect.spectral_radius);
  say(describe_run(scene_, physics_.fibers, physics_.describe_forces(), integrator_->describe(), prospect));
  if (team_ != nullptr) say(describe_ranks(*team_));
}

ExitCode Simulation::run() {
  messages_.events().write("start", {{"nodes", static_cast<std::int64_t>(state_.position.extent(0))},
                                     {"step", state_.step},
                                     {"time", state_.time},
                                     {"method", integrator_->describe()},
                                     {"mobility", physics_.mobility->describe()},
                                     {"backend", describe_backend()}});
  recorder_.trajectory().begin();
  // The first checkpoint stands before the first frame: frames without any are never those of a run that was killed.
  checkpoints_.save();
  recorder_.begin(state_);
  checkpoints_.rehearse();
  try {
    advance_to_end();
  } catch (const Interruption&) {     // the step is given up, and all is as it was before it
  } catch (const RankError& error) {  // so it is here
    messages_.listener().end();
    save_last_good_state(error);
    throw;
  } catch (const Error& error) {
    messages_.listener().end();
    if (error.code() != ExitCode::numerical) throw;
    save_last_good_state(error);
    throw;
  }
  messages_.listener().end();
  const ExitCode code = state_.time < scene_.time.end ? ExitCode::stopped : ExitCode::done;
  checkpoints_.save();
  recorder_.trajectory().finish(code == ExitCode::done ? "done" : "stopped");
  report_end(code);
  return code;
}

void Simulation::advance_to_end() {
  while (state_.time < scene_.time.end) {
    const double time_before = state_.time;
    take_step();
    pass_milestone("step");
    messages_.listener().advance(state_.time, ledger_.evaluations());
    const auto demand = control_.look(step_seconds_);
    if (demand == RunControl::Demand::stop) return;
    const bool is_asked = demand == RunControl::Demand::checkpoint;
    if (state_.time < scene_.time.end && (is_asked || checkpoints_.is_due(time_before))) checkpoints_.save();
  }
}

void Simulation::take_step() {
  const auto start = WallClock::now();
  StepReport report;
  {
    RunLedger::Parts& parts = ledger_.parts();
    const bool is_timed = parts.timed_integration == 0.0 || state_.step % steps_per_timing == 0;
    double untimed = 0.0;
    dynamics_.time_parts(is_timed);
    const Stopwatch stopwatch(parts.integration);  // also a step that is not finished takes time
    const Stopwatch with_parts(is_timed ? parts.timed_integration : untimed);
    report = integrator_->advance(state_, find_next_end(scene_.time, state_.time));
  }
  count(report);
  recorder_.record(state_, report, *integrator_);
  step_seconds_ = seconds_since(start);
}

void Simulation::count(const StepReport& report) {
  ledger_.count(report);
  for (const std::string& message : physics_.mobility->take_messages()) {
    say(fmt::format("t = {:.6g}: {}", state_.time, message));
    messages_.events().write("miss", {{"time", state_.time}, {"step", state_.step}, {"message", message}});
  }
  if (report.rejected == 0) return;
  messages_.events().write("rejected", {{"time", state_.time},
                                        {"attempts", std::int64_t{report.rejected}},
                                        {"dt", report.dt},
                                        {"reason", report.rejection}});
}

void Simulation::save_last_good_state(const Error& error) {
  messages_.note(error.what());
  messages_.events().write("failed", {{"time", state_.time}, {"message", std::string(error.what())}});
  // First the checkpoint, whose trajectory has frames at their own times only.
  checkpoints_.save();
  recorder_.record_last_good(state_);
  recorder_.trajectory().finish("failed");
  say(fmt::format("the last good state, t = {:.6g}, step {}, is in '{}'", state_.time, state_.step,
                  checkpoints_.newest().string()));
  say_cost();
}

CostCard Simulation::say_cost() {
  RunLedger::Parts& parts = ledger_.parts();
  parts.trajectory = recorder_.trajectory().seconds_spent();
  CostCard card = ledger_.make_card(state_.step, largest_length(physics_.fibers));
  card.megabytes += 1e-6 * static_cast<double>(recorder_.trajectory().bytes_written());
  say(describe_cost(card));
  if (const std::string limits = recorder_.describe_limits(); !limits.empty()) say(limits);
  return card;
}

void Simulation::report_end(const ExitCode code) {
  if (code == ExitCode::done)
    say(fmt::format("done: t = {:g}", state_.time));
  else
    say(fmt::format("stopped at t = {:.6g} of {:g} (step {}): {}. 'skein resume {}' goes on.", state_.time,
                    scene_.time.end, state_.step, control_.reason(), folder_.path().string()));
  const CostCard card = say_cost();
  if (team_ != nullptr) say(describe_ranks(*team_));
  const RunLedger::Parts& parts = ledger_.parts();
  messages_.events().write("end", {{"time", state_.time},
                                   {"steps", state_.step},
                                   {"evaluations", ledger_.evaluations()},
                                   {"rejected", ledger_.rejected()},
                                   {"pairs", ledger_.pairs()},
                                   {"estimated_error", ledger_.estimated_error()},
                                   {"velocity_error", card.velocity_errors.largest},
                                   {"checks", card.velocity_errors.n_checks},
                                   {"misses", card.velocity_errors.n_misses},
                                   {"direct_seconds", card.direct_seconds},
                                   {"seconds", card.seconds},
                                   {"seconds_before", card.seconds_before},
                                   {"fluid_seconds", card.fluid},
                                   {"springs_and_flow_seconds", card.springs_and_flow},
                                   {"integrator_seconds", card.integrator},
                                   {"observables_seconds", card.observables},
                                   {"output_seconds", card.output},
                                   {"checkpoint_seconds", parts.checkpoints},
                                   {"frame_seconds", parts.frames}});
}

}  // namespace skein
