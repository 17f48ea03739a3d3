#include "cli/sweep_listener.hpp"

#include <skein/core/duration.hpp>

#include "cli/terminal.hpp"

#include <fmt/format.h>

namespace skein {

void SweepListener::begin(const std::size_t n_open, const int n_jobs, const int n_threads) {
  n_open_ = n_open;
  if (quiet_ || n_open == 0) return;
  print_note(fmt::format("{} of {} runs are open; {} at a time on {} thread{}", n_open, names_.size(), n_jobs,
                         n_threads, n_threads == 1 ? "" : "s"));
}

void SweepListener::end_of_run(const std::size_t run, const RunResult& result, double /*seconds*/) {
  ++n_ended_;
  if (result.code == ExitCode::done) return;
  ++n_failed_;
  progress_.clear();
  print_warning(fmt::format("run {} failed ({}): {}", names_[run], static_cast<int>(result.code), result.message));
}

std::string SweepListener::describe(const std::size_t n_running) const {
  std::string text = fmt::format("{} of {} runs", n_ended_, n_open_);
  if (n_failed_ > 0) text += fmt::format(" ({} failed)", n_failed_);
  text += fmt::format(", {} on their way", n_running);
  if (n_ended_ == 0) return text;
  const double each = progress_.seconds() / static_cast<double>(n_ended_);
  return text + fmt::format(", {} left, {:.3g} runs an hour",
                            format_duration(each * static_cast<double>(n_open_ - n_ended_)), 3600.0 / each);
}

void SweepListener::look(const std::size_t n_running) {
  if (n_open_ == 0 || !progress_.is_due()) return;
  progress_.show(static_cast<double>(n_ended_) / static_cast<double>(n_open_), describe(n_running));
}

}  // namespace skein
