#pragma once

#include <chrono>
#include <cstdint>
#include <string>

namespace skein {

/// How far a run is, and how far it was when this process took over.
struct RunProgress {
  double start_time = 0.0, time = 0.0, end_time = 0.0;  ///< simulated
  std::int64_t start_evaluations = 0, evaluations = 0;  ///< of the right-hand side
  double wall_seconds = 0.0;                            ///< since the start
};

/// "t = 3.2 of 12 (26 %), 17 s left, 0.51 per s, 210 evaluations/s"; rates and time left once they are known.
std::string describe_progress(const RunProgress& progress);

/// "[#####...............]"
std::string draw_bar(double fraction, int width);

/// Tells on stderr how far the run is: on a terminal in a line that is rewritten at most five times a second, else in a
/// new line every minute.
class ProgressReport {
 public:
  enum class Kind { silent, bar, lines };

  /// What suits stderr.
  static Kind choose_kind(bool quiet);

  ProgressReport(Kind kind, double start_time, double end_time, std::int64_t start_evaluations = 0);
  ~ProgressReport();
  ProgressReport(const ProgressReport&) = delete;
  ProgressReport& operator=(const ProgressReport&) = delete;

  /// Cheap: may be called after every step.
  void update(double time, std::int64_t evaluations);

  /// Removes the bar, so that a message can be printed in its place; the next update draws it again.
  void clear();

 private:
  using Clock = std::chrono::steady_clock;

  void draw(const std::string& text) const;

  Kind kind_;
  RunProgress progress_;
  Clock::time_point start_, next_;
  bool bar_is_drawn_ = false;
};

}  // namespace skein
