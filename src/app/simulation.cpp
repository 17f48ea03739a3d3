#include "simulation.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <limits>

#include "app/duration.hpp"
#include "app/run_description.hpp"
#include <skein/analysis/centreline.hpp>
#include <skein/core/error.hpp>
#include <skein/core/runtime.hpp>
#include <skein/hydro/direct_mobility.hpp>
#include <skein/time/make_integrator.hpp>

#include "duration.hpp"
#include "run_description.hpp"

namespace skein {
namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(const Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

std::unique_ptr<Mobility> make_mobility(const SceneConfig& scene) {
  const auto precision = scene.hydrodynamics.precision == "single" ? Precision::in_single : Precision::in_double;
  return std::make_unique<DirectMobility>(scene.fluid.viscosity, precision);
}

/// Wall time of one evaluation: the median of five after a warm-up.
double time_evaluation(FiberDynamics& dynamics, const ConstVectors& position) {
  const Vectors velocity("skein::time_evaluation", position.extent(0));
  std::vector<double> seconds;
  for (int repeat = 0; repeat < 6; ++repeat) {
    const auto start = Clock::now();
    dynamics.compute_velocity(0.0, position, velocity);
    Kokkos::fence();
    if (repeat > 0) seconds.push_back(seconds_since(start));
    if (seconds_since(start) > 1.0) break;  // long runs: a rough figure will do
  }
  if (seconds.empty()) return 0.0;
  std::nth_element(seconds.begin(), seconds.begin() + seconds.size() / 2, seconds.end());
  return seconds[seconds.size() / 2];
}

}  // namespace

Simulation::Simulation(const SceneConfig& scene, const std::string& scene_text, const RunFolder& folder,
                       const ProgressReport::Kind progress, const bool quiet)
    : scene_(scene),
      fibers_(make_fibers(scene.fibers)),
      dynamics_(fibers_, std::make_unique<SpringForces>(fibers_), make_background_flow(scene.flow),
                make_mobility(scene)),
      state_{0.0, 0, to_device("skein::Simulation::position", make_surface_nodes(fibers_))},
      integrator_(make_integrator(scene, fibers_, dynamics_)),
      log_(folder.run_log()),
      events_(folder.events()),
      trajectory_(folder, describe_layout(scene, scene_text, fibers_), scene.output),
      progress_(progress, 0.0, scene.time.end),
      frame_position_("skein::Simulation::frame_position", state_.position.extent(0)),
      quiet_(quiet) {}

void Simulation::introduce() {
  say(describe_run(scene_, fibers_, dynamics_, *integrator_, time_evaluation(dynamics_, state_.position)));
}

std::string describe_dry_run(const SceneConfig& scene) {
  const auto fibers = make_fibers(scene.fibers);
  FiberDynamics dynamics(fibers, std::make_unique<SpringForces>(fibers), make_background_flow(scene.flow),
                         make_mobility(scene));
  const auto integrator = make_integrator(scene, fibers, dynamics);
  const Vectors position = to_device("skein::describe_dry_run", make_surface_nodes(fibers));
  return describe_run(scene, fibers, dynamics, *integrator, time_evaluation(dynamics, position));
}

void Simulation::say(const std::string& text) {
  log_.write(text);
  if (quiet_) return;
  progress_.clear();
  std::fprintf(stderr, "%s\n", text.c_str());
}

ExitCode Simulation::run(const double max_walltime) {
  const auto start = Clock::now();
  events_.write("start", {{"nodes", static_cast<std::int64_t>(state_.position.extent(0))},
                          {"method", integrator_->describe()},
                          {"mobility", dynamics_.mobility().describe()},
                          {"backend", describe_backend()}});
  if (next_frame_ == 0) {
    write_frame(0, 0.0, state_.position);
    next_frame_ = 1;
  }
  ExitCode code = ExitCode::done;
  try {
    while (state_.time < scene_.time.end) {
      const StepReport report = integrator_->advance(state_, scene_.time.end);
      if (report.rejected > 0) {
        rejected_ += report.rejected;
        events_.write("rejected",
                      {{"time", state_.time}, {"attempts", std::int64_t{report.rejected}}, {"dt", report.dt}});
      }
      record_step(report);
      write_frames_up_to(state_.time);
      seconds_ = seconds_since(start);
      progress_.update(state_.time, dynamics_.evaluations());
      if (max_walltime > 0.0 && seconds_ > max_walltime && state_.time < scene_.time.end) {
        code = ExitCode::stopped;
        break;
      }
    }
  } catch (const Error& error) {
    if (error.code() != ExitCode::numerical) throw;
    progress_.clear();
    log_.write(error.what());
    events_.write("failed", {{"time", state_.time}, {"message", std::string(error.what())}});
    if (state_.time > (static_cast<double>(next_frame_) - 1.0) * scene_.output.frame_interval)
      write_frame(state_.step, state_.time, state_.position);
    trajectory_.finish("failed");
    throw;
  }
  seconds_ = seconds_since(start);
  trajectory_.finish(code == ExitCode::done ? "done" : "stopped");
  say(code == ExitCode::done
          ? fmt::format("done: t = {:g}", state_.time)
          : fmt::format("stopped at t = {:g} of {:g}: the wall time is used up", state_.time, scene_.time.end));
  say(describe_cost());
  events_.write("end", {{"time", state_.time},
                        {"steps", state_.step},
                        {"evaluations", dynamics_.evaluations()},
                        {"seconds", seconds_},
                        {"pairs", dynamics_.mobility().pairs()}});
  return code;
}

void Simulation::write_frames_up_to(const double time) {
  const double interval = scene_.output.frame_interval;
  const double end = scene_.time.end;
  for (;;) {
    // The last frame is the end of the run, whether or not it is a multiple of the interval.
    const double due = std::min(static_cast<double>(next_frame_) * interval, end);
    const bool after_end = static_cast<double>(next_frame_ - 1) * interval >= end;
    if (due > time || after_end) return;
    if (due == time) {
      write_frame(state_.step, time, state_.position);
    } else {
      integrator_->interpolate(due, frame_position_);
      write_frame(state_.step - 1, due, frame_position_);
    }
    ++next_frame_;
  }
}

void Simulation::write_frame(const std::int64_t step, const double time, const ConstVectors& position) {
  Frame frame{step, time, to_host(position), compute_centreline(fibers_, position), {}};
  for (const Fiber& fiber : fibers_) {
    const auto curvature = compute_curvature(centreline_of(fiber, frame.centreline));
    frame.curvature.insert(frame.curvature.end(), curvature.begin(), curvature.end());
  }
  trajectory_.append(frame);
}

void Simulation::record_step(const StepReport& report) {
  StepRecord record;
  record.step = state_.step;
  record.time = state_.time;
  record.dt = report.dt;
  record.error = report.error;
  record.spectral_radius = report.spectral_radius;
  record.evaluations = dynamics_.evaluations();
  record.energy = dynamics_.springs().compute_energies(state_.position);
  const auto centreline = compute_centreline(fibers_, state_.position);
  record.smallest_gap = compute_smallest_gap(fibers_, centreline);
  for (const Fiber& fiber : fibers_) {
    const auto line = centreline_of(fiber, centreline);
    const auto curvature = compute_curvature(line);
    record.length.push_back(compute_length(line));
    record.curvature_max.push_back(*std::max_element(curvature.begin(), curvature.end()));
    record.end_to_end.push_back(compute_end_to_end(line));
  }
  trajectory_.append(record);
}

std::string Simulation::describe_cost() const {
  const double evaluations = static_cast<double>(dynamics_.evaluations());
  return fmt::format(
      "cost: {} wall time; {} steps ({} rejected), {} evaluations of {:.3g} ms; {:.3g} pairs/s over the whole run; "
      "output "
      "{:.2f} % of the time, {:.1f} MB",
      format_duration(seconds_), state_.step, rejected_, dynamics_.evaluations(), 1e3 * seconds_ / evaluations,
      dynamics_.mobility().pairs() / seconds_, 100.0 * trajectory_.seconds_spent() / seconds_,
      1e-6 * static_cast<double>(trajectory_.bytes_written()));
}

}  // namespace skein
