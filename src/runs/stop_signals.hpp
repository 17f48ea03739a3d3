#pragma once

#include <csignal>

namespace skein {

/// While it lives, SIGINT, SIGTERM and SIGUSR1 are counted instead of ending the process, and a closed stderr or a
/// limit on file sizes make writes fail instead. One at a time.
class StopSignals {
 public:
  StopSignals();
  ~StopSignals();
  StopSignals(const StopSignals&) = delete;
  StopSignals& operator=(const StopSignals&) = delete;

  int count() const;         ///< signals since the construction
  const char* name() const;  ///< "SIGTERM": the last one's

 private:
  static constexpr int n_signals = 5;
  struct sigaction old_actions_[n_signals];
};

}  // namespace skein
