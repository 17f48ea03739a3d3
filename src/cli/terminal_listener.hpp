#pragma once

#include "cli/progress.hpp"
#include "runs/run_listener.hpp"

#include <optional>

namespace skein {

/// Shows a run on stderr: its messages, and its progress in a form that suits stderr.
class TerminalListener final : public RunListener {
 public:
  explicit TerminalListener(bool quiet) : quiet_(quiet) {}

  void begin(double time, double end_time, std::int64_t evaluations) override;
  void say(const std::string& text) override;
  void advance(double time, std::int64_t evaluations) override;
  void end() override;

 private:
  bool quiet_;
  std::optional<ProgressReport> progress_;
};

}  // namespace skein
