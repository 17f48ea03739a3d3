#pragma once

#include <skein/core/stopwatch.hpp>
#include <skein/dynamics/fiber_dynamics.hpp>
#include <skein/solvers/integrator.hpp>

#include "runs/cost_card.hpp"

#include <cstdint>

namespace skein {

/// What a run takes: counted over all processes that took part in it, and timed in this one.
class RunLedger {
 public:
  /// @param dynamics  whose evaluations are counted; must outlive the ledger
  explicit RunLedger(const FiberDynamics& dynamics) : dynamics_(dynamics) {}

  /// The counts of the whole run up to the last accepted step.
  void visit_memory(MemoryVisitor& visitor);

  /// What this process adds is counted from here. @param step  accepted ones so far
  void begin(std::int64_t step);

  /// Evaluations made until now only measured what they cost.
  void exclude_evaluations();

  /// An accepted step.
  void count(const StepReport& report);

  std::int64_t evaluations() const { return counts_.evaluations; }
  std::int64_t rejected() const { return counts_.rejected; }
  double pairs() const { return counts_.pairs; }
  double estimated_error() const { return counts_.estimated_error; }

  /// Wall time of the run in all processes, seconds; kept in the counts when a checkpoint is made.
  double seconds() const { return counts_at_start_.seconds + seconds_since(start_); }
  void keep_seconds() { counts_.seconds = seconds(); }

  /// Wall time of the parts of this process's work, seconds.
  struct Parts {
    double integration = 0.0, observables = 0.0, frames = 0.0, checkpoints = 0.0;
    double timed_integration =
        0.0;                  ///< of steps in which the dynamics timed its parts; the others are taken to be alike
    double trajectory = 0.0;  ///< of the class that writes it, as it says itself
    double direct_sums_each = 0.0;  ///< an evaluation by a direct sum would take, estimated; 0: that is the method
    double megabytes = 0.0;         ///< written
  };
  Parts& parts() { return parts_; }

  /// @param length  of the longest fiber
  CostCard make_card(std::int64_t step, double length) const;

 private:
  struct Counts {
    std::int64_t evaluations = 0, rejected = 0;
    double pairs = 0.0, seconds = 0.0;
    double estimated_error = 0.0;  ///< sum of the steps' estimates, root mean square over nodes, length
  };

  const FiberDynamics& dynamics_;
  WallClock::time_point start_ = WallClock::now();
  Counts counts_, counts_at_start_;
  Parts parts_;
  std::int64_t step_at_start_ = 0, spare_evaluations_ = 0;
  double spare_pairs_ = 0.0, largest_error_ = 0.0;
};

}  // namespace skein
