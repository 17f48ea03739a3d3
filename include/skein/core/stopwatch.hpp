#pragma once

#include <chrono>

namespace skein {

using WallClock = std::chrono::steady_clock;

inline double seconds_since(const WallClock::time_point start) {
  return std::chrono::duration<double>(WallClock::now() - start).count();
}

/// Adds the wall time it lived, in seconds, to a sum.
class Stopwatch {
 public:
  explicit Stopwatch(double& sum) : sum_(sum) {}
  ~Stopwatch() { sum_ += seconds_since(start_); }
  Stopwatch(const Stopwatch&) = delete;
  Stopwatch& operator=(const Stopwatch&) = delete;

 private:
  double& sum_;
  WallClock::time_point start_ = WallClock::now();
};

}  // namespace skein
