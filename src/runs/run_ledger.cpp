#include "runs/run_ledger.hpp"

#include <algorithm>

namespace skein {

void RunLedger::visit_memory(MemoryVisitor& visitor) {
  visitor.integer("run.evaluations", counts_.evaluations);
  visitor.integer("run.rejected", counts_.rejected);
  visitor.number("run.pairs", counts_.pairs);
  visitor.number("run.seconds", counts_.seconds);
  visitor.number("run.estimated_error", counts_.estimated_error);
}

void RunLedger::begin(const std::int64_t step) {
  counts_at_start_ = counts_;
  step_at_start_ = step;
}

void RunLedger::exclude_evaluations() {
  spare_evaluations_ = dynamics_.evaluations();
  spare_pairs_ = dynamics_.physics().mobility->pairs();
}

void RunLedger::count(const StepReport& report) {
  counts_.evaluations = counts_at_start_.evaluations + dynamics_.evaluations() - spare_evaluations_;
  counts_.pairs = counts_at_start_.pairs + dynamics_.physics().mobility->pairs() - spare_pairs_;
  counts_.estimated_error += report.local_error;
  counts_.rejected += report.rejected;
  largest_error_ = std::max(largest_error_, report.error);
}

CostCard RunLedger::make_card(const std::int64_t step, const double length) const {
  const Mobility& mobility = *dynamics_.physics().mobility;
  CostCard card;
  card.seconds = seconds_since(start_);
  card.seconds_before = counts_at_start_.seconds;
  card.steps = step - step_at_start_;
  card.rejected = counts_.rejected - counts_at_start_.rejected;
  card.evaluations = dynamics_.evaluations() - spare_evaluations_;
  card.pairs = mobility.pairs() - spare_pairs_;
  const double share = parts_.timed_integration > 0.0 ? parts_.integration / parts_.timed_integration : 0.0;
  card.fluid = share * dynamics_.seconds().fluid;
  card.springs_and_flow = share * dynamics_.seconds().springs_and_flow;
  card.integrator = parts_.integration - card.fluid - card.springs_and_flow;
  card.observables = parts_.observables;
  card.output = parts_.trajectory + parts_.frames + parts_.checkpoints;
  card.megabytes = parts_.megabytes;
  card.largest_error = largest_error_;
  card.estimated_error = counts_.estimated_error / length;
  card.mobility = mobility.describe();
  card.velocity_errors = mobility.error_record();
  card.direct_seconds = parts_.direct_sums_each * static_cast<double>(card.evaluations);
  return card;
}

}  // namespace skein
