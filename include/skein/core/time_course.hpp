#pragma once

#include <limits>
#include <set>
#include <vector>

namespace skein {

/// When something changes by itself, and how fast: the times at which it is not smooth, at which steps have to end, and
/// the longest step that sees what it does in between. It follows from a scene alone.
class TimeCourse {
 public:
  /// What lasts from begin to end, and is not smooth at either; times of 0 and infinity are no ends.
  /// @param longest_step  that sees it; > 0, time
  void add_piece(double begin, double end, double longest_step = std::numeric_limits<double>::infinity());

  /// The same for what oscillates with this period, > 0, and for a rise or a fall, which is half of an oscillation.
  void add_oscillation(double begin, double end, double period);
  void add_ramp(double begin, double end) { add_oscillation(begin, end, 2.0 * (end - begin)); }

  /// A step takes a sixteenth of a period at most.
  static constexpr double steps_per_period = 16.0;

  bool is_break(double time) const { return breaks_.count(time) > 0; }
  double next_break(double time) const;  ///< > time; infinity: there is none

  /// Of a step that starts at this time and does not pass a break; never so short that rounding would stop the clock.
  double longest_step(double time) const;

 private:
  struct Piece {
    double begin, end, longest_step;
  };
  std::set<double> breaks_;
  std::vector<Piece> pieces_;  ///< that limit steps
};

}  // namespace skein
