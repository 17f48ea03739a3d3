#include "cli/terminal_listener.hpp"

#include "cli/terminal.hpp"

namespace skein {

void TerminalListener::begin(const double time, const double end_time, const std::int64_t evaluations) {
  progress_.emplace(ProgressLine::choose_kind(quiet_), time, end_time, evaluations);
}

void TerminalListener::say(const std::string& text) {
  if (quiet_) return;
  if (progress_) progress_->clear();
  print_message(text);
}

void TerminalListener::advance(const double time, const std::int64_t evaluations) {
  if (progress_) progress_->update(time, evaluations);
}

void TerminalListener::end() {
  if (progress_) progress_->clear();
}

}  // namespace skein
