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

/// Tells on stderr how far something is: on a terminal in a line that is rewritten at most five times a second, else in
/// a new line every minute.
class ProgressLine {
 public:
  enum class Kind { silent, bar, lines };

  /// What suits stderr.
  static Kind choose_kind(bool quiet);

  explicit ProgressLine(Kind kind);
  ~ProgressLine();
  ProgressLine(const ProgressLine&) = delete;
  ProgressLine& operator=(const ProgressLine&) = delete;

  /// Whether it is time to tell. Cheap.
  bool is_due() const;
  void show(double fraction, const std::string& text);
  double seconds() const;  ///< since it was made

  /// Removes the bar, so that a message can be printed in its place; the next show draws it again.
  void clear();

 private:
  using Clock = std::chrono::steady_clock;

  void draw(double fraction, const std::string& text) const;

  Kind kind_;
  Clock::time_point start_, next_;
  bool bar_is_drawn_ = false;
};

/// How far a run is.
class ProgressReport {
 public:
  ProgressReport(ProgressLine::Kind kind, double start_time, double end_time, std::int64_t start_evaluations = 0);

  /// Cheap: may be called after every step.
  void update(double time, std::int64_t evaluations);

  /// Makes room for a message.
  void clear() { line_.clear(); }

 private:
  RunProgress progress_;
  ProgressLine line_;
};

}  // namespace skein
