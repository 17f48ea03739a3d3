#pragma once

#include "cli/progress.hpp"
#include "studies/side_by_side.hpp"

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

namespace skein {

/// Shows on stderr how runs side by side go: how many are done, and each that fails.
class SweepListener : public SideBySideListener {
 public:
  /// @param names   of the runs
  /// @param quiet   only failures
  SweepListener(const std::vector<std::string>& names, bool quiet)
      : names_(names), quiet_(quiet), progress_(ProgressLine::choose_kind(quiet)) {}

  void begin(std::size_t n_open, int n_jobs, int n_threads) override;
  void end_of_run(std::size_t run, const RunResult& result, double seconds) override;
  void look(std::size_t n_running) override;

 private:
  std::string describe(std::size_t n_running) const;

  const std::vector<std::string>& names_;
  bool quiet_;
  ProgressLine progress_;
  std::size_t n_open_ = 0, n_ended_ = 0, n_failed_ = 0;
};

}  // namespace skein
