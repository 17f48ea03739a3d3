#pragma once

#include <csignal>

namespace skein {

/// While it lives, what users, terminals and batch systems end a process with (SIGINT, SIGTERM, SIGHUP, SIGXCPU,
/// SIGUSR1, SIGUSR2, SIGALRM) is counted instead. A SIGHUP that was ignored before, as nohup does, stays so. One at a
/// time.
class StopSignals {
 public:
  StopSignals();
  ~StopSignals();
  StopSignals(const StopSignals&) = delete;
  StopSignals& operator=(const StopSignals&) = delete;

  /// In a process that is a copy of this one: they end it again.
  static void let_them_end_this_process();

  int count() const;         ///< signals since the construction
  int number() const;        ///< SIGTERM: the last one
  const char* name() const;  ///< "SIGTERM": the last one's

 private:
  static constexpr int n_signals = 7;
  struct sigaction old_actions_[n_signals];
};

}  // namespace skein
