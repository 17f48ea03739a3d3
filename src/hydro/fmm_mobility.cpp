#include <skein/hydro/fmm_mobility.hpp>

#include <skein/core/error.hpp>

#include "fmm_evaluator.hpp"
#include "kernels/combination.hpp"

#include <fmt/format.h>

#include <cmath>
#include <limits>
#include <utility>

namespace skein {
namespace {

/// Errors below this part of the velocities that the sum is added to are rounding: of fibers at rest in a flow.
constexpr double rounding = 1e-12;

constexpr double min_fmm_pairs = 5e5;  ///< fewer are summed directly before a tree is built

HostNodes copy_to_host(const Sources& sources, const ConstVectors& target) {
  HostNodes nodes;
  nodes.position = Kokkos::create_mirror_view_and_copy(Kokkos::HostSpace(), sources.position);
  nodes.force = Kokkos::create_mirror_view_and_copy(Kokkos::HostSpace(), sources.force);
  nodes.blob = Kokkos::create_mirror_view_and_copy(Kokkos::HostSpace(), sources.blob);
  const bool same = target.data() == sources.position.data() && target.extent(0) == sources.position.extent(0);
  if (same)
    nodes.target = nodes.position;
  else
    nodes.target = Kokkos::create_mirror_view_and_copy(Kokkos::HostSpace(), target);
  return nodes;
}

/// Without a branch, for vector instructions.
bool is_finite(const ConstVectorView<HostSpace>& vectors) {
  int any = 0;
  for (int c = 0; c < 3; ++c) {
    const double* x = vectors.extent(0) > 0 ? &vectors(0, c) : nullptr;
    for (int i = 0; i < vectors.extent_int(0); ++i) any |= !(x[i] - x[i] == 0.0);
  }
  return any == 0;
}

/// Which targets are compared: spread evenly over the indices.
struct Sample {
  int n_targets, n_checked;
  Sample(const int n, const int n_wanted) : n_targets(n), n_checked(math::smaller(n, n_wanted)) {}
  int index(const int i) const {
    return static_cast<int>((2 * static_cast<std::int64_t>(i) + 1) * n_targets / (2 * n_checked));
  }
};

/// 2-norms at the compared targets.
struct Comparison {
  double difference = 0.0, size = 0.0;
  double relative() const { return size > 0.0 ? difference / size : difference; }
};

Comparison compare(const double viscosity, const Sources& sources, const HostNodes& nodes, const HostVectors& velocity,
                   const Sample& sample) {
  const Vectors target("checked_target", sample.n_checked), exact("checked_velocity", sample.n_checked);
  const auto host_target = Kokkos::create_mirror_view(target);
  for (int i = 0; i < sample.n_checked; ++i) store(host_target, i, load(nodes.target, sample.index(i)));
  Kokkos::deep_copy(target, host_target);
  DirectMobility(viscosity, Precision::in_double).add_velocity(sources, target, exact);
  const auto host_exact = Kokkos::create_mirror_view_and_copy(Kokkos::HostSpace(), exact);
  Comparison sum;
  for (int i = 0; i < sample.n_checked; ++i) {
    const Vec3 u = load(host_exact, i), d = load(velocity, sample.index(i)) - u;
    sum.difference += dot(d, d);
    sum.size += dot(u, u);
  }
  return {std::sqrt(sum.difference), std::sqrt(sum.size)};
}

double norm_at(const Vectors& velocity, const Sample& sample) {
  const auto host = Kokkos::create_mirror_view_and_copy(Kokkos::HostSpace(), velocity);
  double sum = 0.0;
  for (int i = 0; i < sample.n_checked; ++i) {
    const Vec3 u = load(host, sample.index(i));
    sum += dot(u, u);
  }
  return std::sqrt(sum);
}

Precision precision_of_direct_sums(const FmmOptions& options) {
  return options.precision == FmmPrecision::in_single ? Precision::in_single : Precision::in_double;
}

}  // namespace

FmmMobility::FmmMobility(const double viscosity, const FmmOptions& options)
    : viscosity_(viscosity),
      options_(options),
      direct_(viscosity, precision_of_direct_sums(options)),
      evaluator_(std::make_unique<FmmEvaluator>()) {
  SKEIN_REQUIRE(viscosity > 0.0, "the viscosity must be positive");
  if (!(options.direct_when_cheaper && needs_direct_sum(options))) check_fmm_options(options);
}

FmmMobility::~FmmMobility() = default;

const FmmStatistics& FmmMobility::statistics() const { return evaluator_->statistics; }

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
  evaluator_->statistics.used_direct_sum = true;
  if (sums_directly(n_pairs)) return direct_.add_velocity(sources, target, velocity);

  const HostNodes nodes = copy_to_host(sources, target);
  if (!is_finite(nodes.position) || !is_finite(nodes.target))
    return Kokkos::deep_copy(velocity, std::numeric_limits<double>::quiet_NaN());
  while (evaluate(nodes))
    if (!is_checked || passes_check(sources, nodes, velocity)) {
      ++record_.n_approximate;
      record_.order = evaluator_->statistics.plan.order;
      const Vectors own = Kokkos::create_mirror_view_and_copy(ExecSpace::memory_space(), own_velocity_);
      return combine<ExecSpace>(ExecSpace(), velocity, {1.0, velocity}, {1.0, own});
    }
  direct_.add_velocity(sources, target, velocity);
}

bool FmmMobility::sums_directly(const double n_pairs) const {
  return options_.direct_when_cheaper && (n_pairs < min_fmm_pairs || needs_direct_sum(options_));
}

bool FmmMobility::evaluate(const HostNodes& nodes) {
  const FmmPlan plan = choose_fmm_plan(options_, range_of(nodes.blob).largest, raised_order_);
  if (own_velocity_.extent(0) == nodes.target.extent(0))
    Kokkos::deep_copy(own_velocity_, 0.0);
  else
    own_velocity_ = HostVectors("fmm_velocity", nodes.target.extent(0));
  const bool is_done = evaluator_->add(options_, plan, viscosity_, nodes, own_velocity_);
  evaluator_->statistics.used_direct_sum = !is_done;
  return is_done;
}

bool FmmMobility::passes_check(const Sources& sources, const HostNodes& nodes, const Vectors& velocity) {
  const Sample sample(nodes.target.extent_int(0), options_.n_checked_targets);
  const Comparison comparison = compare(viscosity_, sources, nodes, own_velocity_, sample);
  if (comparison.difference < rounding * norm_at(velocity, sample)) return true;
  record_.last = comparison.relative();
  record_.largest = std::isnan(record_.largest) ? record_.last : std::fmax(record_.largest, record_.last);
  ++record_.n_checks;
  if (!(record_.last > options_.tolerance)) return true;  // not a number: the time step finds out and names the node
  ++record_.n_misses;
  const int order = evaluator_->statistics.plan.order;
  const std::string miss = fmt::format(
      "the fast multipole method at order {} misses tolerance = {:g}: its error at {} checked targets is {:.2g}", order,
      options_.tolerance, sample.n_checked, record_.last);
  const int next_order = choose_fmm_plan(options_, 0.0, order + 1).order;
  if (options_.on_miss == OnMiss::stop || next_order <= order)
    throw Error(ExitCode::numerical, miss + "; raise the tolerance or use method = \"direct\"");
  messages_.push_back(fmt::format("{}; order {} from here on", miss, next_order));
  raised_order_ = next_order;
  return false;
}

double FmmMobility::measure_error(const Sources& sources, const ConstVectors& target, const int n_sample) {
  if (sources.position.extent(0) == 0 || target.extent(0) == 0) return 0.0;
  const HostNodes nodes = copy_to_host(sources, target);
  if (!evaluate(nodes)) return 0.0;
  return compare(viscosity_, sources, nodes, own_velocity_, {nodes.target.extent_int(0), n_sample}).relative();
}

void FmmMobility::visit_memory(MemoryVisitor& visitor) {
  visitor.count("mobility.raised_order", raised_order_);
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
  const FmmStatistics& last = evaluator_->statistics;
  return describe_fmm_plan(options_, last.n_boxes > 0 ? last.plan : choose_fmm_plan(options_, 0.0, raised_order_));
}

}  // namespace skein
