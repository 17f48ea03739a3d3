#include <skein/core/error.hpp>
#include <skein/fmm/fmm_cost.hpp>
#include <skein/fmm/fmm_sum.hpp>
#include <skein/fmm/machine_rates.hpp>
#include <skein/physics/fmm_mobility.hpp>
#include <skein/physics/sum_team.hpp>

#include "kernels/node_checks.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace skein {
namespace {

/// Errors below this part of the velocities that the sum is added to are rounding: of fibers at rest in a flow.
constexpr double rounding = 1e-12;

/// Of the tolerance, that a lower order may use up to be taken again; and how rare the tries become, in checks.
constexpr double lowering_share = 0.5;
constexpr std::int64_t longest_lowering_wait = 512;

constexpr double min_fmm_pairs = 5e5;  ///< fewer are summed directly before a tree is built

/// 2-norms at the compared targets.
struct Comparison {
  double difference = 0.0, size = 0.0;
  double relative() const { return size > 0.0 ? difference / size : difference; }
};

Comparison compare(const double viscosity, const Sources& sources, const ConstVectors& target,
                   const FmmSum& approximate, const EvenSample& sample) {
  const Vectors checked =
      to_device("skein::fmm_mobility::checked_target", read_sample<ExecSpace>(ExecSpace(), target, sample));
  const Vectors exact("skein::fmm_mobility::checked_velocity", sample.n_chosen);
  DirectMobility(viscosity, Precision::in_double).add_velocity(sources, checked, exact);
  const std::vector<Vec3> got = approximate.sample(sample), wanted = to_host(exact);
  Comparison sum;
  for (std::size_t i = 0; i < got.size(); ++i) {
    const Vec3 u = wanted[i], d = got[i] - u;
    sum.difference += dot(d, d);
    sum.size += dot(u, u);
  }
  return {std::sqrt(sum.difference), std::sqrt(sum.size)};
}

double norm_at(const Vectors& velocity, const EvenSample& sample) {
  double sum = 0.0;
  for (const Vec3 u : read_sample<ExecSpace>(ExecSpace(), velocity, sample)) sum += dot(u, u);
  return std::sqrt(sum);
}

}  // namespace

FmmMobility::FmmMobility(const double viscosity, const FmmOptions& options, SumTeam* team)
    : viscosity_(viscosity),
      options_(options),
      team_(team),
      direct_(viscosity, options.precision, options.path, team),
      direct_in_single_(viscosity, Precision::in_single, options.path, team),
      sum_(team == nullptr ? make_fmm_sum(options.path) : team->make_fmm_sum(options.path)) {
  SKEIN_REQUIRE(viscosity > 0.0, "the viscosity must be positive");
  if (!(options.direct_when_cheaper && needs_direct_sum(options))) check_fmm_options(options);
}

FmmMobility::~FmmMobility() = default;

const FmmStatistics& FmmMobility::statistics() const { return sum_->statistics; }

void FmmMobility::time_parts(const bool on) { sum_->times_parts = on; }

void FmmMobility::add_velocity(const Sources& sources, const ConstVectors& target, const Vectors& velocity) {
  SKEIN_REQUIRE(
      sources.position.extent(0) == sources.force.extent(0) && sources.position.extent(0) == sources.blob.extent(0),
      "positions, forces and blobs of the sources differ in number");
  SKEIN_REQUIRE(target.extent(0) == velocity.extent(0), "targets and velocities differ in number");
  const bool is_checked = options_.check_every > 0 && n_evaluations_ % options_.check_every == 0;
  ++n_evaluations_;
  if (sources.position.extent(0) == 0 || target.extent(0) == 0) return;
  const double n_pairs = static_cast<double>(sources.position.extent(0)) * static_cast<double>(target.extent(0));
  pairs_ += n_pairs;
  record_.order = 0;
  sum_->statistics.used_direct_sum = true;
  const FmmTargets targets = place_of(sources, target);
  if (sums_directly(n_pairs, targets)) return direct_sum_of(n_pairs).add_velocity(sources, target, velocity);

  if (!sum_->take(sources, target)) return Kokkos::deep_copy(velocity, std::numeric_limits<double>::quiet_NaN());
  if (is_checked && lowers_order(sources, target, targets)) return use_sum(velocity);
  while (evaluate(targets))
    if (!is_checked || passes_check(sources, target, velocity)) return use_sum(velocity);
  direct_sum_of(n_pairs).add_velocity(sources, target, velocity);
}

void FmmMobility::use_sum(const Vectors& velocity) {
  ++record_.n_approximate;
  record_.order = sum_->statistics.plan.order;
  sum_->add_to(velocity);
}

bool FmmMobility::sums_directly_in_single(const double n_pairs) const {
  return options_.precision == Precision::automatic &&
         choose_direct_precision(machine_rates(options_.path), n_pairs, options_.tolerance) == Precision::in_single;
}

double FmmMobility::relative_cost(const NodeLines& nodes) const {
  const double n_pairs = nodes.n_nodes * nodes.n_nodes;
  if (n_pairs == 0.0) return 1.0;
  const DirectMobility& direct = sums_directly_in_single(n_pairs) ? direct_in_single_ : direct_;
  const double of_direct = direct.relative_cost(nodes);
  if (sums_directly(n_pairs, FmmTargets::at_sources)) return of_direct;
  const FmmPlan plan = choose_fmm_plan(options_, nodes.max_blob, 0);
  const MachineRates& rates = machine_rates(options_.path);
  const FmmWork work = expect_work_along_lines(nodes.n_nodes, nodes.length, plan);
  const double of_method = (estimate_nanoseconds(work, plan, true, options_.path) + rates.tree) /
                           rates.direct_nanoseconds(true, false, n_pairs);
  return options_.direct_when_cheaper ? std::min(of_direct, of_method) : of_method;
}

FmmTargets FmmMobility::place_of(const Sources& sources, const ConstVectors& target) const {
  return are_same_nodes(sources.position, target) ? FmmTargets::at_sources : options_.other_targets;
}

bool FmmMobility::sums_directly(const double n_pairs, const FmmTargets targets) const {
  // Beside the sources the method may promise less than among them; an order that is set by hand is taken as it is.
  const bool is_planned = options_.order == 0 && options_.min_half_width == 0.0;
  if (targets == FmmTargets::apart && is_planned && needs_direct_sum(options_, targets)) return true;
  return options_.direct_when_cheaper && (n_pairs < min_fmm_pairs || needs_direct_sum(options_, targets));
}

bool FmmMobility::evaluate(const FmmTargets targets) {
  const FmmPlan plan = choose_fmm_plan(options_, sum_->largest_blob(), raised_order_, targets);
  const bool is_done = sum_->compute(options_, plan, viscosity_);
  sum_->statistics.used_direct_sum = !is_done;
  return is_done;
}

bool FmmMobility::passes_check(const Sources& sources, const ConstVectors& target, const Vectors& velocity) {
  const EvenSample sample(target.extent_int(0), options_.n_checked_targets);
  if (team_ != nullptr) team_->complete(sources);
  const Comparison comparison = compare(viscosity_, sources, target, *sum_, sample);
  if (team_ != nullptr) team_->complete(velocity);
  if (comparison.difference < rounding * norm_at(velocity, sample)) return true;
  note_check(comparison.relative());
  if (!(record_.last > options_.tolerance)) return true;  // not a number: the time step finds out and names the node
  ++record_.n_misses;
  const int order = sum_->statistics.plan.order;
  const std::string miss = fmt::format(
      "the fast multipole method at order {} misses tolerance = {:g}: its error at {} checked targets is {:.2g}", order,
      options_.tolerance, sample.n_chosen, record_.last);
  const int next_order = choose_fmm_plan(options_, 0.0, order + 1).order;
  if (options_.on_miss == OnMiss::stop || next_order <= order)
    throw Error(ExitCode::numerical, miss + "; raise the tolerance or use method = \"direct\"");
  messages_.push_back(fmt::format("{}; order {} from here on", miss, next_order));
  raised_order_ = next_order;
  if (record_.n_misses > 1) lowering_wait_ = std::min(2 * lowering_wait_, longest_lowering_wait);
  next_lowering_ = record_.n_checks + lowering_wait_;
  return false;
}

bool FmmMobility::lowers_order(const Sources& sources, const ConstVectors& target, const FmmTargets targets) {
  if (raised_order_ == 0 || record_.n_checks < next_lowering_) return false;
  const int raised = raised_order_, lower = raised - 1;
  raised_order_ = lower > choose_fmm_plan(options_, 0.0, 0).order ? lower : 0;
  const EvenSample sample(target.extent_int(0), options_.n_checked_targets);
  const bool has_sum = evaluate(targets);
  if (team_ != nullptr) team_->complete(sources);
  const double error = has_sum ? compare(viscosity_, sources, target, *sum_, sample).relative() : 0.0;
  const bool is_met = has_sum && error <= lowering_share * options_.tolerance;
  if (is_met) {
    note_check(error);
    messages_.push_back(fmt::format(
        "the fast multipole method meets tolerance = {:g} at order {} again: its error at {} checked targets "
        "is {:.2g}; that order from here on",
        options_.tolerance, sum_->statistics.plan.order, sample.n_chosen, error));
  } else {
    raised_order_ = raised;
    lowering_wait_ = std::min(2 * lowering_wait_, longest_lowering_wait);
  }
  next_lowering_ = record_.n_checks + lowering_wait_;
  return is_met;
}

void FmmMobility::note_check(const double error) {
  record_.last = error;
  record_.largest = std::isnan(record_.largest) ? error : std::fmax(record_.largest, error);
  ++record_.n_checks;
}

double FmmMobility::measure_error(const Sources& sources, const ConstVectors& target, const int n_sample) {
  if (sources.position.extent(0) == 0 || target.extent(0) == 0) return 0.0;
  sum_->take(sources, target);
  if (!evaluate(place_of(sources, target))) return 0.0;
  return compare(viscosity_, sources, target, *sum_, {target.extent_int(0), n_sample}).relative();
}

void FmmMobility::visit_memory(MemoryVisitor& visitor) {
  visitor.count("mobility.raised_order", raised_order_);
  visitor.integer("mobility.next_lowering", next_lowering_);
  visitor.integer("mobility.lowering_wait", lowering_wait_);
  visitor.integer("mobility.evaluations", n_evaluations_);
  visitor.count("mobility.order", record_.order);
  visitor.number("mobility.last_error", record_.last);
  visitor.number("mobility.largest_error", record_.largest);
  visitor.integer("mobility.checks", record_.n_checks);
  visitor.integer("mobility.misses", record_.n_misses);
  visitor.integer("mobility.approximate", record_.n_approximate);
}

std::vector<std::string> FmmMobility::take_messages() { return std::exchange(messages_, {}); }

std::string FmmMobility::describe() const {
  if (options_.direct_when_cheaper && needs_direct_sum(options_))
    return fmt::format("direct sum: tolerance {:g} is below what the fast multipole method promises",
                       options_.tolerance);
  const FmmStatistics& last = sum_->statistics;
  return describe_fmm_plan(options_, last.n_boxes > 0 ? last.plan : choose_fmm_plan(options_, 0.0, raised_order_));
}

}  // namespace skein
