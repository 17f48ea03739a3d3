#pragma once

#include <string>
#include <vector>

// When a rank counts as lost: rules without clocks or messages of their own, so that tests can say what time it is.
// Times are seconds since any moment.

namespace skein {

/// When other ranks were last heard of.
class PulseBook {
 public:
  static constexpr double longest_silence = 5.0;
  static constexpr double longest_own_gap = 2.0;

  explicit PulseBook(const std::vector<int>& watched, double now);

  void hear(int rank, double now);

  /// To be called many times a second. After a gap this process was stopped itself, perhaps with all others, as by
  /// Ctrl-Z: then nobody is late.
  /// @returns a rank that has been silent for too long, or -1
  int look(double now);

 private:
  std::vector<int> watched_;
  std::vector<double> last_;
  double last_look_;
};

/// What is known of the work that this process is in the middle of, and takes no end.
class WorkWatch {
 public:
  static constexpr double longest_idling = 5.0;  ///< while it should compute
  static constexpr double least_share = 0.01;    ///< of a processor, that is no idling
  static constexpr double spare = 4.0;           ///< and so many times the longest piece of work before:
  static constexpr double times_longest = 20.0;

  /// @param work_since     when the piece of work began that is going on; negative: none is
  /// @param processor_time  of the process, seconds
  /// @returns what is wrong, in words that follow "rank 2 "; empty: nothing
  std::string look(double now, double work_since, double longest_work, double processor_time);

 private:
  double work_since_ = -1.0, idle_since_ = 0.0, processor_time_ = 0.0, last_look_ = 0.0;
};

}  // namespace skein
