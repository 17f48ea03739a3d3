#include "cli/progress.hpp"

#include <skein/core/duration.hpp>

#include "cli/terminal.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace skein {
namespace {

constexpr std::chrono::milliseconds bar_interval(200);
constexpr std::chrono::seconds line_interval(60);
constexpr int bar_width = 12;

double compute_fraction(const RunProgress& progress) {
  if (!(progress.end_time > 0.0)) return 1.0;
  return std::clamp(progress.time / progress.end_time, 0.0, 1.0);
}

void print(const std::string& text) {
  std::fwrite(text.data(), 1, text.size(), stderr);
  std::fflush(stderr);
}

}  // namespace

std::string describe_progress(const RunProgress& progress) {
  // Rounded down: 100 % only at the end.
  std::string text = fmt::format("t = {:.4g} of {:.4g} ({:.0f} %)", progress.time, progress.end_time,
                                 std::floor(100.0 * compute_fraction(progress)));
  const double advanced = progress.time - progress.start_time;
  if (!(advanced > 0.0 && progress.wall_seconds > 0.0)) return text;

  const double rate = advanced / progress.wall_seconds;
  const auto evaluations = static_cast<double>(progress.evaluations - progress.start_evaluations);
  // What matters least stands last: a narrow terminal cuts it off.
  return text + fmt::format(", {} left, {:.3g} per s, {:.3g} evaluations/s",
                            format_duration((progress.end_time - progress.time) / rate), rate,
                            evaluations / progress.wall_seconds);
}

std::string draw_bar(const double fraction, const int width) {
  const int n_full = static_cast<int>(std::floor(std::clamp(fraction, 0.0, 1.0) * width));
  return "[" + std::string(n_full, '#') + std::string(width - n_full, '.') + "]";
}

ProgressLine::Kind ProgressLine::choose_kind(const bool quiet) {
  if (quiet) return Kind::silent;
  return stderr_is_terminal() ? Kind::bar : Kind::lines;
}

ProgressLine::ProgressLine(const Kind kind)
    : kind_(kind), start_(Clock::now()), next_(start_ + (kind == Kind::bar ? bar_interval : line_interval)) {}

ProgressLine::~ProgressLine() { clear(); }

bool ProgressLine::is_due() const { return kind_ != Kind::silent && Clock::now() >= next_; }

double ProgressLine::seconds() const { return std::chrono::duration<double>(Clock::now() - start_).count(); }

void ProgressLine::show(const double fraction, const std::string& text) {
  if (kind_ == Kind::silent) return;
  if (kind_ == Kind::bar) {
    draw(fraction, text);
    bar_is_drawn_ = true;
    next_ = Clock::now() + bar_interval;
  } else {
    print(text + "\n");
    next_ = Clock::now() + line_interval;
  }
}

void ProgressLine::draw(const double fraction, const std::string& text) const {
  const std::string bar = draw_bar(fraction, bar_width);
  // A line that wraps could not be rewritten.
  const auto n_columns = static_cast<std::size_t>(count_terminal_columns());
  const std::string cut = text.substr(0, n_columns > bar.size() + 2 ? n_columns - bar.size() - 2 : 0);
  const bool colored = stderr_has_color();
  print(fmt::format("\r{}{}{} {}\033[K", colored ? "\033[32m" : "", bar, colored ? "\033[0m" : "", cut));
}

void ProgressLine::clear() {
  if (bar_is_drawn_) print("\r\033[K");
  bar_is_drawn_ = false;
}

ProgressReport::ProgressReport(const ProgressLine::Kind kind, const double start_time, const double end_time,
                               const std::int64_t start_evaluations)
    : line_(kind) {
  progress_.start_time = progress_.time = start_time;
  progress_.end_time = end_time;
  progress_.start_evaluations = start_evaluations;
}

void ProgressReport::update(const double time, const std::int64_t evaluations) {
  if (!line_.is_due()) return;
  progress_.time = time;
  progress_.evaluations = evaluations;
  progress_.wall_seconds = line_.seconds();
  line_.show(compute_fraction(progress_), describe_progress(progress_));
}

}  // namespace skein
