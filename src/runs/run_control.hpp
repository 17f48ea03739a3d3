#pragma once

#include <skein/io/run_folder.hpp>

#include "runs/stop_signals.hpp"

#include <chrono>
#include <cmath>
#include <exception>
#include <filesystem>
#include <string>

namespace skein {

/// Leaves a step that may not be finished any more.
class Interruption : public std::exception {
 public:
  const char* what() const noexcept override { return "the run is asked to stop"; }
};

/// What users and batch systems ask of a run while it is on its way: signals, the files STOP and OUTPUT_NOW in its
/// folder, and the end of its wall time.
class RunControl {
 public:
  enum class Demand { none, checkpoint, stop };

  /// @param max_walltime  seconds since the program began, checkpoint included; infinity for no limit
  explicit RunControl(double max_walltime);

  /// The folder whose files are looked for; a STOP file of an earlier time is removed.
  void watch(const RunFolder& folder);

  /// Asks for a stop from within the run. @param reason  in words; an earlier one stays
  void ask_to_stop(const std::string& reason);

  /// To be asked after every step. @param step_seconds  wall time of the last one
  Demand look(double step_seconds);

  /// To be called at every evaluation. @throws Interruption at the second signal, when a request to stop is `patience`
  /// old, and when the wall time would not suffice for a checkpoint any more.
  void check_within_step();
  static constexpr double patience = 3.0;  ///< seconds

  /// For a program whose launcher kills it soon after it has passed a signal on. @param seconds  in place of `patience`
  void set_patience(const double seconds) { patience_ = seconds; }

  /// True if the run has to end in time, with a checkpoint.
  bool has_walltime() const { return std::isfinite(max_walltime_); }

  /// How long a checkpoint took: time for a slower one is kept free.
  void note_checkpoint(double seconds);

  const std::string& reason() const { return reason_; }                        ///< of the stop, in words
  int signal() const { return signals_.count() > 0 ? signals_.number() : 0; }  ///< the last one received; 0: none
  static double seconds_since_program_start();

 private:
  using Clock = std::chrono::steady_clock;

  bool stop_is_asked();
  void look_for_files();
  double seconds_left() const;

  StopSignals signals_;
  double max_walltime_;
  double slowest_checkpoint_ = 0.1;
  double patience_ = patience;
  std::filesystem::path stop_file_, output_file_;
  bool checkpoint_is_asked_ = false;
  Clock::time_point next_look_{}, asked_at_{};
  std::string reason_;
};

}  // namespace skein
