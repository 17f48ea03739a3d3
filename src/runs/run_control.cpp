#include "runs/run_control.hpp"

#include <algorithm>
#include <system_error>

namespace skein {
namespace {

constexpr std::chrono::milliseconds look_interval(200);
constexpr double spare_checkpoints = 2.0;  // a checkpoint may take that many times longer than any before
const std::chrono::steady_clock::time_point program_start = std::chrono::steady_clock::now();

}  // namespace

RunControl::RunControl(const double max_walltime) : max_walltime_(max_walltime) {}

double RunControl::seconds_since_program_start() {
  return std::chrono::duration<double>(Clock::now() - program_start).count();
}

void RunControl::watch(const RunFolder& folder) {
  stop_file_ = folder.stop_request();
  output_file_ = folder.output_request();
  std::error_code ignored;
  std::filesystem::remove(stop_file_, ignored);
}

void RunControl::look_for_files() {
  const auto now = Clock::now();
  if (stop_file_.empty() || now < next_look_) return;
  next_look_ = now + look_interval;
  std::error_code ignored;
  if (reason_.empty() && std::filesystem::exists(stop_file_, ignored)) {
    reason_ = "a file STOP is in its folder";
    asked_at_ = now;
  }
  if (std::filesystem::remove(output_file_, ignored)) checkpoint_is_asked_ = true;
}

bool RunControl::stop_is_asked() {
  if (reason_.empty() && signals_.count() > 0) {
    reason_ = std::string("it received ") + signals_.name();
    asked_at_ = Clock::now();
  }
  look_for_files();
  return !reason_.empty();
}

double RunControl::seconds_left() const {
  return max_walltime_ - seconds_since_program_start() - spare_checkpoints * slowest_checkpoint_;
}

void RunControl::ask_to_stop(const std::string& reason) {
  if (!reason_.empty()) return;
  reason_ = reason;
  asked_at_ = Clock::now();
}

RunControl::Demand RunControl::look(const double step_seconds) {
  if (!stop_is_asked() && seconds_left() < step_seconds) reason_ = "its wall time is used up";
  if (!reason_.empty()) return Demand::stop;
  if (!checkpoint_is_asked_) return Demand::none;
  checkpoint_is_asked_ = false;
  return Demand::checkpoint;
}

void RunControl::check_within_step() {
  if (stop_is_asked() &&
      (signals_.count() > 1 || std::chrono::duration<double>(Clock::now() - asked_at_).count() > patience_))
    throw Interruption();
  if (seconds_left() > 0.0) return;
  if (reason_.empty()) reason_ = "its wall time is used up";
  throw Interruption();
}

void RunControl::note_checkpoint(const double seconds) { slowest_checkpoint_ = std::max(slowest_checkpoint_, seconds); }

}  // namespace skein
