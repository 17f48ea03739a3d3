#include "runs/simulation.hpp"

#include <skein/arrays/runtime.hpp>
#include <skein/core/kill_point.hpp>
#include <skein/core/version.hpp>
#include <skein/dynamics/make_integrator.hpp>
#include <skein/io/atomic_file.hpp>
#include <skein/physics/make_mobility.hpp>

#include "runs/checkpoint_memory.hpp"
#include "runs/evaluation_time.hpp"
#include "runs/observables.hpp"
#include "runs/run_description.hpp"
#include "runs/simulate.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace skein {
namespace {

std::unique_ptr<Mobility> add_fault(std::unique_ptr<Mobility> mobility, const FaultOrder& order,
                                    const CurrentStep& step) {
  if (order.target != "force") return mobility;
  return std::make_unique<FaultyMobility>(std::move(mobility), order, step);
}

TrajectoryEnd find_start(const RunFolder& folder, const Checkpoint* checkpoint) {
  return checkpoint == nullptr ? find_trajectory_start(folder) : read_trajectory_end(*checkpoint);
}

}  // namespace

Simulation::Simulation(const SceneConfig& scene, const RunFolder& folder, const Checkpoint* checkpoint,
                       RunControl& control, const ProgressReport::Kind progress, const bool quiet)
    : scene_(scene),
      folder_(folder),
      control_(control),
      fibers_(make_fibers(scene.fibers)),
      fault_order_(read_fault_order()),
      dynamics_(fibers_, std::make_unique<SpringForces>(fibers_), make_background_flow(scene.flows),
                add_fault(make_mobility(scene), fault_order_, current_step_),
                make_section_repulsion(scene.repulsion, fibers_)),
      faulty_dynamics_(dynamics_, fault_order_, current_step_),
      watched_dynamics_(fault_order_.target.empty() ? static_cast<RightHandSide&>(dynamics_) : faulty_dynamics_,
                        control),
      state_{0.0, 0, to_device("skein::Simulation::position", make_surface_nodes(fibers_, scene.seed))},
      integrator_(make_integrator(scene, fibers_, watched_dynamics_)),
      log_(folder.run_log()),
      events_(folder.events()),
      trajectory_(folder, describe_layout(scene, read_file(folder.scene()), fibers_), scene.output,
                  find_start(folder, checkpoint)),
      checkpoints_(folder),
      progress_(progress, checkpoint == nullptr ? 0.0 : checkpoint->number("state.time"), scene.time.end,
                checkpoint == nullptr ? 0 : checkpoint->integer("run.evaluations")),
      frame_position_("skein::Simulation::frame_position", state_.position.extent(0)),
      guard_(fibers_, dynamics_.repulsion() != nullptr),
      last_checkpoint_(WallClock::now()),
      quiet_(quiet) {
  control_.watch(folder);
  if (checkpoint != nullptr) restore(*checkpoint);
  counters_at_start_ = counters_;
  steps_at_start_ = state_.step;
}

void Simulation::Counters::visit_memory(MemoryVisitor& visitor) {
  visitor.integer("run.evaluations", evaluations);
  visitor.integer("run.rejected", rejected);
  visitor.integer("run.next_frame", next_frame);
  visitor.number("run.pairs", pairs);
  visitor.number("run.seconds", seconds);
  visitor.number("run.estimated_error", estimated_error);
}

void Simulation::restore(const Checkpoint& checkpoint) {
  MemoryRestorer restorer(checkpoint);
  visit_memory(restorer, state_);
  integrator_->visit_memory(restorer);
  dynamics_.visit_memory(restorer);
  counters_.visit_memory(restorer);
  guard_.visit_memory(restorer);
  step_of_checkpoint_ = state_.step;
}

void Simulation::save_checkpoint() {
  if (step_of_checkpoint_ == state_.step) return;
  const auto start = WallClock::now();
  const double trajectory_seconds = trajectory_.seconds_spent();
  trajectory_.close_segment();
  counters_.seconds = seconds_of_run();
  Checkpoint checkpoint;
  MemorySaver saver(checkpoint);
  visit_memory(saver, state_);
  integrator_->visit_memory(saver);
  dynamics_.visit_memory(saver);
  counters_.visit_memory(saver);
  guard_.visit_memory(saver);
  write_trajectory_end(checkpoint, trajectory_.end());
  checkpoint.set("scene.xxh3", find_trajectory_start(folder_).checksum);
  checkpoint.set("scene.seed", std::vector<std::int64_t>{static_cast<std::int64_t>(scene_.seed)});
  checkpoint.set("program.version", std::string(version()));
  checkpoint.set("program.commit", std::string(commit()));
  checkpoint.set("program.backend", describe_backend());
  checkpoint_bytes_ += checkpoints_.write(checkpoint, scene_.checkpoint.keep);
  step_of_checkpoint_ = state_.step;
  last_checkpoint_ = WallClock::now();
  const double seconds = seconds_since(start);
  control_.note_checkpoint(seconds);
  checkpoint_seconds_ += seconds - (trajectory_.seconds_spent() - trajectory_seconds);
  events_.write(
      "checkpoint",
      {{"number", checkpoints_.last_number()}, {"time", state_.time}, {"step", state_.step}, {"seconds", seconds}});
}

bool Simulation::checkpoint_is_due(const double time_before) const {
  const CheckpointConfig& config = scene_.checkpoint;
  if (config.wall_interval > 0.0 && seconds_since(last_checkpoint_) >= config.wall_interval) return true;
  const double interval = config.simulated_interval;
  return interval > 0.0 && std::floor(state_.time / interval) > std::floor(time_before / interval);
}

void Simulation::introduce() {
  // Evaluations that only measure their cost leave no trace.
  const Remembered before(dynamics_);
  EvaluationCost cost;
  try {
    cost = time_evaluation(dynamics_, state_.position);
    if (dynamics_.mobility().error_record().n_approximate > 0)
      direct_seconds_ = cost.direct_seconds = time_direct_sum(state_.position, scene_.fluid.viscosity);
  } catch (const Error& error) {  // the first step meets it, too, and there is a checkpoint then
    if (error.code() != ExitCode::numerical) throw;
  }
  before.bring_back(dynamics_);
  dynamics_.take_messages();
  spare_evaluations_ = dynamics_.evaluations();
  spare_pairs_ = dynamics_.mobility().pairs();
  spare_seconds_ = dynamics_.seconds();
  say(describe_run(scene_, fibers_, integrator_->describe(), cost));
}

void Simulation::say(const std::string& text) {
  log_.write(text);
  if (quiet_) return;
  progress_.clear();
  std::fprintf(stderr, "%s\n", text.c_str());
}

void Simulation::say_cost(const CostCard& card) {
  say(describe_cost(card));
  if (const std::string limits = guard_.describe(); !limits.empty()) say(limits);
}

double Simulation::seconds_of_run() const { return counters_at_start_.seconds + seconds_since(start_); }

ExitCode Simulation::run() {
  events_.write("start", {{"nodes", static_cast<std::int64_t>(state_.position.extent(0))},
                          {"step", state_.step},
                          {"time", state_.time},
                          {"method", integrator_->describe()},
                          {"mobility", dynamics_.mobility().describe()},
                          {"backend", describe_backend()}});
  if (counters_.next_frame == 0) {
    write_frame(0, 0.0, state_.position);
    counters_.next_frame = 1;
  } else {
    regimes_ = classify_frame(fibers_, make_frame(fibers_, state_.step, state_.time, state_.position));
  }
  try {
    advance_to_end();
  } catch (const Interruption&) {  // the step is given up, and all is as it was before it
  } catch (const Error& error) {
    if (error.code() != ExitCode::numerical) throw;
    save_last_good_state(error);
    throw;
  }
  const ExitCode code = state_.time < scene_.time.end ? ExitCode::stopped : ExitCode::done;
  save_checkpoint();
  trajectory_.finish(code == ExitCode::done ? "done" : "stopped");
  report_end(code);
  return code;
}

void Simulation::advance_to_end() {
  while (state_.time < scene_.time.end) {
    const double time_before = state_.time;
    take_step();
    reach_kill_point("step");
    progress_.update(state_.time, counters_.evaluations);
    const auto demand = control_.look(step_seconds_);
    if (demand == RunControl::Demand::stop) return;
    if (state_.time < scene_.time.end && (demand == RunControl::Demand::checkpoint || checkpoint_is_due(time_before)))
      save_checkpoint();
  }
}

void Simulation::take_step() {
  const auto start = WallClock::now();
  current_step_.number = state_.step + 1;
  const StepReport report = advance();
  count(report);
  const auto recording = WallClock::now();
  double in_trajectory = trajectory_.seconds_spent();
  record_step(report);
  observables_seconds_ += seconds_since(recording) - (trajectory_.seconds_spent() - in_trajectory);
  const auto framing = WallClock::now();
  in_trajectory = trajectory_.seconds_spent();
  write_frames_up_to(state_.time);
  frame_seconds_ += seconds_since(framing) - (trajectory_.seconds_spent() - in_trajectory);
  step_seconds_ = seconds_since(start);
}

StepReport Simulation::advance() {
  // Also steps that are not finished take time.
  const Stopwatch stopwatch(integration_seconds_);
  const Remembered before(dynamics_);
  try {
    return integrator_->advance(state_, scene_.time.end);
  } catch (...) {
    before.bring_back(dynamics_);
    throw;
  }
}

void Simulation::count(const StepReport& report) {
  counters_.evaluations = counters_at_start_.evaluations + dynamics_.evaluations() - spare_evaluations_;
  counters_.pairs = counters_at_start_.pairs + dynamics_.mobility().pairs() - spare_pairs_;
  counters_.estimated_error += report.local_error;
  largest_error_ = std::max(largest_error_, report.error);
  for (const std::string& message : dynamics_.take_messages()) {
    say(fmt::format("t = {:.6g}: {}", state_.time, message));
    events_.write("miss", {{"time", state_.time}, {"step", state_.step}, {"message", message}});
  }
  if (report.rejected == 0) return;
  counters_.rejected += report.rejected;
  events_.write("rejected", {{"time", state_.time},
                             {"attempts", std::int64_t{report.rejected}},
                             {"dt", report.dt},
                             {"reason", report.rejection}});
}

void Simulation::save_last_good_state(const Error& error) {
  progress_.clear();
  log_.write(error.what());
  events_.write("failed", {{"time", state_.time}, {"message", std::string(error.what())}});
  // First the checkpoint, whose trajectory has frames at their own times only.
  save_checkpoint();
  if (state_.time > (static_cast<double>(counters_.next_frame) - 1.0) * scene_.output.frame_interval)
    write_frame(state_.step, state_.time, state_.position);
  trajectory_.finish("failed");
  say(fmt::format("the last good state, t = {:.6g}, step {}, is in '{}'", state_.time, state_.step,
                  checkpoints_.path_of(checkpoints_.last_number()).string()));
  say_cost(make_cost_card());
}

void Simulation::report_end(const ExitCode code) {
  if (code == ExitCode::done)
    say(fmt::format("done: t = {:g}", state_.time));
  else
    say(fmt::format("stopped at t = {:.6g} of {:g} (step {}): {}. 'skein resume {}' goes on.", state_.time,
                    scene_.time.end, state_.step, control_.reason(), folder_.path().string()));
  const CostCard card = make_cost_card();
  say_cost(card);
  events_.write("end", {{"time", state_.time},
                        {"steps", state_.step},
                        {"evaluations", counters_.evaluations},
                        {"rejected", counters_.rejected},
                        {"pairs", counters_.pairs},
                        {"estimated_error", counters_.estimated_error},
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
                        {"checkpoint_seconds", checkpoint_seconds_},
                        {"frame_seconds", frame_seconds_}});
}

CostCard Simulation::make_cost_card() const {
  CostCard card;
  card.seconds = seconds_since(start_);
  card.seconds_before = counters_at_start_.seconds;
  card.steps = state_.step - steps_at_start_;
  card.rejected = counters_.rejected - counters_at_start_.rejected;
  card.evaluations = dynamics_.evaluations() - spare_evaluations_;
  card.pairs = dynamics_.mobility().pairs() - spare_pairs_;
  card.fluid = dynamics_.seconds().fluid - spare_seconds_.fluid;
  card.springs_and_flow = dynamics_.seconds().springs_and_flow - spare_seconds_.springs_and_flow;
  card.integrator = integration_seconds_ - card.fluid - card.springs_and_flow;
  card.observables = observables_seconds_;
  card.output = trajectory_.seconds_spent() + frame_seconds_ + checkpoint_seconds_;
  card.megabytes = 1e-6 * static_cast<double>(trajectory_.bytes_written() + checkpoint_bytes_);
  card.largest_error = largest_error_;
  card.estimated_error = counters_.estimated_error / largest_length(fibers_);
  card.mobility = dynamics_.mobility().describe();
  card.velocity_errors = dynamics_.mobility().error_record();
  card.direct_seconds = direct_seconds_ * static_cast<double>(card.evaluations);
  return card;
}

void Simulation::write_frames_up_to(const double time) {
  const double interval = scene_.output.frame_interval;
  const double end = scene_.time.end;
  for (;;) {
    // The last frame is the end of the run, whether or not it is a multiple of the interval.
    const auto next = static_cast<double>(counters_.next_frame);
    const double due = std::min(next * interval, end);
    const bool after_end = (next - 1.0) * interval >= end;
    if (due > time || after_end) return;
    if (due == time) {
      write_frame(state_.step, time, state_.position);
    } else {
      integrator_->interpolate(due, frame_position_);
      write_frame(state_.step - 1, due, frame_position_);
    }
    ++counters_.next_frame;
  }
}

void Simulation::write_frame(const std::int64_t step, const double time, const ConstVectors& position) {
  const Frame frame = make_frame(fibers_, step, time, position);
  trajectory_.append(frame);
  note_regimes(frame);
}

void Simulation::note_regimes(const Frame& frame) {
  const auto regimes = classify_frame(fibers_, frame);
  for (std::size_t f = 0; f < regimes.size() && !regimes_.empty(); ++f) {
    if (regimes[f] == regimes_[f]) continue;
    events_.write("regime", {{"time", frame.time},
                             {"fiber", static_cast<std::int64_t>(f)},
                             {"regime", std::string(name_of(regimes[f]))},
                             {"before", std::string(name_of(regimes_[f]))}});
    log_.write(fmt::format("t = {:.6g}: fiber {} is in regime {}, was in {}", frame.time, f, name_of(regimes[f]),
                           name_of(regimes_[f])));
  }
  regimes_ = regimes;
}

void Simulation::record_step(const StepReport& report) {
  StepRecord record = make_step_record(fibers_, dynamics_, state_, report);
  record.evaluations = counters_.evaluations;
  record.estimated_error = counters_.estimated_error;
  const ErrorRecord errors = dynamics_.mobility().error_record();
  record.velocity_error = errors.last;
  record.fmm_order = errors.order;
  record.fmm_misses = errors.n_misses;
  trajectory_.append(record);
  for (const std::string& warning : guard_.look(record, dynamics_.springs().compute_largest_strain(state_.position))) {
    say(warning);
    events_.write("warning", {{"time", state_.time}, {"step", state_.step}, {"message", warning}});
  }
}

ExitCode simulate(const SceneConfig& scene, const RunFolder& folder, const Checkpoint* checkpoint, RunControl& control,
                  const ProgressReport::Kind progress, const bool quiet, const std::string& first_words) {
  Simulation simulation(scene, folder, checkpoint, control, progress, quiet);
  if (!first_words.empty()) simulation.say(first_words);
  simulation.introduce();
  return simulation.run();
}

std::string describe_dry_run(const SceneConfig& scene) {
  const auto fibers = make_fibers(scene.fibers);
  FiberDynamics dynamics(fibers, std::make_unique<SpringForces>(fibers), make_background_flow(scene.flows),
                         make_mobility(scene), make_section_repulsion(scene.repulsion, fibers));
  const auto integrator = make_integrator(scene, fibers, dynamics);
  const Vectors position = to_device("skein::describe_dry_run", make_surface_nodes(fibers, scene.seed));
  EvaluationCost cost = time_evaluation(dynamics, position);
  if (dynamics.mobility().error_record().n_approximate > 0)
    cost.direct_seconds = time_direct_sum(position, scene.fluid.viscosity);
  return describe_run(scene, fibers, integrator->describe(), cost);
}

}  // namespace skein
