#pragma once

#include "studies/acceptance.hpp"
#include "studies/lagrone2019.hpp"
#include "studies/paper_scenes.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <utility>
#include <vector>

namespace skein {

/// Rows of one figure, which compare_with_paper() names.
class FigureRows {
 public:
  void add(const std::string& quantity, const std::string& source, AcceptanceRow row) {
    row.quantity = quantity;
    row.source = source;
    rows_.push_back(std::move(row));
  }
  std::vector<AcceptanceRow> take() { return std::move(rows_); }

 private:
  std::vector<AcceptanceRow> rows_;
};

/// The run of one fiber, asked about moments it may not have reached.
class PaperRun {
 public:
  PaperRun(const PaperRuns& runs, const std::string& name) {
    const auto found = runs.find(name);
    if (found == runs.end()) return;
    analysis_ = &found->second;
    history_ = &analysis_->histories[0];
    summary_ = history_->summarize();
  }

  bool has(const double time) const { return analysis_ != nullptr && analysis_->time.back() >= time - 1e-9; }
  const FiberSummary& summary() const { return summary_; }

  std::size_t frame(const double time) const {
    const auto& times = analysis_->time;
    const auto after = std::lower_bound(times.begin(), times.end(), time - 1e-9);
    return static_cast<std::size_t>(std::min(after, times.end() - 1) - times.begin());
  }
  template <class Measure>
  double at(const double time, const Measure& measure) const {
    return has(time) ? static_cast<double>(measure(history_->shapes()[frame(time)])) : none;
  }
  /// Degrees clockwise from +x, without jumps.
  double angle(const double time) const { return has(time) ? degrees * history_->angles()[frame(time)] : none; }
  std::string regime(const double time) const { return has(time) ? name_of(history_->regimes()[frame(time)]) : ""; }
  double half_period() const {
    return analysis_ == nullptr || summary_.half_periods.empty() ? none : summary_.half_periods[0];
  }
  std::string wave(const double time) const { return has(time) ? name_of(summary_.wave) : ""; }
  double count_hooks(const double time) const {
    if (!has(time)) return none;
    const std::size_t i = frame(time);
    return static_cast<double>(history_->hooks(FiberEnd::first)[i].has_value() +
                               history_->hooks(FiberEnd::last)[i].has_value());
  }
  /// Of the two hooks' peaks from their ends, over the length.
  double hook_place(const double time) const {
    if (count_hooks(time) != 2.0) return none;
    const std::size_t i = frame(time);
    return 0.5 * (history_->hooks(FiberEnd::first)[i]->arclength + history_->hooks(FiberEnd::last)[i]->arclength) /
           history_->shapes()[i].length;
  }
  double radii_out_of_plane(const double time) const {
    return at(time, [](const Shape& shape) { return shape.out_of_plane / paper_radius; });
  }
  /// The first moment at which the fiber is a radius out of its plane; infinite if it stays in it to `end`.
  double time_out_of_plane(const double end) const {
    if (!has(end)) return none;
    const auto& shapes = history_->shapes();
    const auto found = std::find_if(shapes.begin(), shapes.end(),
                                    [](const Shape& shape) { return shape.out_of_plane >= paper_radius; });
    return found == shapes.end() ? std::numeric_limits<double>::infinity()
                                 : analysis_->time[static_cast<std::size_t>(found - shapes.begin())];
  }
  /// Of the frames up to the first half period, those in which the fiber is straight to a percent and within ten
  /// degrees of x.
  double share_at_rest() const {
    const double end = half_period();
    if (!has(end)) return none;
    std::size_t n_at_rest = 0;
    const std::vector<double> angles = history_->angles();
    for (std::size_t i = 0; i <= frame(end); ++i) {
      const Shape& shape = history_->shapes()[i];
      n_at_rest += shape.distance > 0.99 * shape.length && std::abs(std::sin(angles[i])) < std::sin(10.0 / degrees);
    }
    return static_cast<double>(n_at_rest) / static_cast<double>(frame(end) + 1);
  }
  const FiberHistory* history() const { return history_; }

 private:
  static constexpr double none = std::numeric_limits<double>::quiet_NaN();  ///< not reached

  const RunAnalysis* analysis_ = nullptr;
  const FiberHistory* history_ = nullptr;
  FiberSummary summary_;
};

}  // namespace skein
