#include <skein/hydro/fmm_mobility.hpp>

#include <skein/core/error.hpp>

#include "kernels/fmm_translations.hpp"
#include "operator_store.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <utility>

namespace skein {
namespace {

constexpr double min_fmm_pairs = 5e5;  ///< fewer are summed directly before a tree is built

class Stopwatch {
 public:
  double lap() {
    const double now = seconds();
    return now - std::exchange(start_, now);
  }

 private:
#ifdef SKEIN_FMM_CPU_TIME
  static double seconds() {
    timespec t;
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
    return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
  }
#else
  static double seconds() {
    return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
  }
#endif
  double start_ = seconds();
};

struct HostNodes {
  ConstVectorView<HostSpace> position, force, target;
  ConstScalarView<HostSpace> blob;
};

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

void resize(HostVectors& array, const int n, const char* label) {
  if (array.extent_int(0) != n)
    array = HostVectors(Kokkos::view_alloc(std::string(label), Kokkos::WithoutInitializing), n);
}

struct BlobRange {
  double smallest, largest;
};

BlobRange range_of(const ConstScalarView<HostSpace>& blob) {
  BlobRange range{blob(0), blob(0)};
  for (int i = 1; i < blob.extent_int(0); ++i) {
    range.smallest = std::min(range.smallest, blob(i));
    range.largest = std::max(range.largest, blob(i));
  }
  return range;
}

}  // namespace

class FmmMobility::Evaluator {
 public:
  /// velocity += the sum after a plan; false, and nothing done, where a direct sum is cheaper and may be used.
  bool add(const FmmOptions& options, FmmPlan plan, double viscosity, const HostNodes& nodes,
           const HostVectors& velocity);

  FmmStatistics statistics;
  int raised_order = 0;  ///< that a check found necessary; 0: as planned

 private:
  void sort_nodes(const HostNodes& nodes, double scale);
  template <class Real>
  void add_in(const FmmOptions& options, const FmmPlan& plan, double blob, OperatorStore<Real>& store,
              Coefficients<Real>& coefficients, const HostVectors& velocity);
  template <class Real, class Field>
  void pass(const FmmPlan& plan, const Field& field, const std::vector<const OperatorSet<Real>*>& levels,
            Coefficients<Real>& coefficients, const HostVectors& velocity);
  void count_work(const FmmPlan& plan);
  double node_bytes() const;

  Octree tree_;
  SortedNodes sorted_;
  OperatorStore<double> operators_;
  OperatorStore<float> single_operators_;
  Coefficients<double> coefficients_;
  Coefficients<float> single_coefficients_;
  std::vector<TargetTask> tasks_;
};

void FmmMobility::Evaluator::sort_nodes(const HostNodes& nodes, const double scale) {
  const int n_sources = nodes.position.extent_int(0), n_targets = nodes.target.extent_int(0);
  const bool same = nodes.target.data() == nodes.position.data() && n_sources == n_targets;
  resize(sorted_.position, n_sources, "sorted_position");
  resize(sorted_.force, n_sources, "sorted_force");
  if (sorted_.blob.extent_int(0) != n_sources) sorted_.blob = HostScalars("sorted_blob", n_sources);
  if (same)
    sorted_.target = sorted_.position;
  else if (sorted_.target.data() == sorted_.position.data() || sorted_.target.extent_int(0) != n_targets)
    sorted_.target = HostVectors("sorted_target", n_targets);
  const auto sorted = sorted_;
  const auto source_order = tree_.source_order(), target_order = tree_.target_order();
  Kokkos::parallel_for("skein::sort_sources", Kokkos::RangePolicy<HostSpace>(HostSpace(), 0, n_sources),
                       [=](const int i) {
                         const int from = source_order(i);
                         store(sorted.position, i, load(nodes.position, from));
                         store(sorted.force, i, scale * load(nodes.force, from));
                         sorted.blob(i) = nodes.blob(from);
                       });
  if (!same)
    Kokkos::parallel_for("skein::sort_targets", Kokkos::RangePolicy<HostSpace>(HostSpace(), 0, n_targets),
                         [=](const int i) { store(sorted.target, i, load(nodes.target, target_order(i))); });
}

template <class Real, class Field>
void FmmMobility::Evaluator::pass(const FmmPlan& plan, const Field& field,
                                  const std::vector<const OperatorSet<Real>*>& levels, Coefficients<Real>& coefficients,
                                  const HostVectors& velocity) {
  Stopwatch watch;
  coefficients.stride = 0;
  for (const auto* level : levels)
    if (level != nullptr) coefficients.stride = math::larger(coefficients.stride, level->rank_padded);
  coefficients.box_size = Field::n_columns * coefficients.stride;
  const std::size_t needed = tree_.boxes().size() * static_cast<std::size_t>(coefficients.box_size);
  if (coefficients.source.extent(0) < needed) {
    coefficients.source = {};  // before the new ones are allocated
    coefficients.target = {};
    coefficients.source = Kokkos::View<Real*, HostSpace>(
        Kokkos::view_alloc(std::string("source_coefficients"), Kokkos::WithoutInitializing), needed + needed / 8);
    coefficients.target = Kokkos::View<Real*, HostSpace>(
        Kokkos::view_alloc(std::string("target_coefficients"), Kokkos::WithoutInitializing), needed + needed / 8);
  }
  compute_coefficients<Real, Field>(tree_, sorted_, field, levels, coefficients);
  statistics.far_seconds = watch.lap();
  if constexpr (std::is_same_v<Real, float>) {
    if (plan.near_in_single)
      add_leaf_velocities<float, Real, Field>(tree_, sorted_, field, levels, coefficients, tasks_, velocity);
    else
      add_leaf_velocities<double, Real, Field>(tree_, sorted_, field, levels, coefficients, tasks_, velocity);
  } else {
    add_leaf_velocities<double, Real, Field>(tree_, sorted_, field, levels, coefficients, tasks_, velocity);
  }
  statistics.leaf_seconds = watch.lap();
}

template <class Real>
void FmmMobility::Evaluator::add_in(const FmmOptions& options, const FmmPlan& plan, const double blob,
                                    OperatorStore<Real>& store, Coefficients<Real>& coefficients,
                                    const HostVectors& velocity) {
  Stopwatch watch;
  const auto levels = store.require(options.far_field, plan, blob, tree_);
  statistics.operators_seconds = watch.lap();
  if (options.far_field == FarField::harmonic)
    pass<Real>(plan, HarmonicField{}, levels, coefficients, velocity);
  else if (options.far_field == FarField::stokeslet)
    pass<Real>(plan, StokesletField{options.stokes_part_only}, levels, coefficients, velocity);
  else
    pass<Real>(plan, RegularizedField{blob * blob}, levels, coefficients, velocity);
  statistics.memory_bytes = store.bytes() + 2.0 * sizeof(Real) * static_cast<double>(coefficients.source.size()) +
                            node_bytes() + tree_.bytes();
}

void FmmMobility::Evaluator::count_work(const FmmPlan& plan) {
  statistics.plan = plan;
  statistics.n_boxes = static_cast<int>(tree_.boxes().size());
  statistics.n_levels = tree_.n_levels();
  statistics.n_leaves = static_cast<int>(tree_.target_leaves().size());
  statistics.smallest_half_width = tree_.half_width(tree_.n_levels() - 1);
  statistics.work.n_sources = static_cast<double>(tree_.source_order().extent(0));
  statistics.work.n_targets = static_cast<double>(tree_.target_order().extent(0));
  statistics.work.n_boxes = static_cast<double>(tree_.boxes().size());
  statistics.work.far_pairs = static_cast<double>(tree_.far_pairs().entries.size());
  statistics.work.near_pairs = 0.0;
  for (int leaf = 0; leaf < statistics.n_leaves; ++leaf) {
    double n_sources = 0.0;
    for (const Run* run = tree_.near_sources().begin(leaf); run != tree_.near_sources().end(leaf); ++run)
      n_sources += run->count;
    const auto box = static_cast<std::size_t>(tree_.target_leaves()[static_cast<std::size_t>(leaf)]);
    statistics.work.near_pairs += n_sources * tree_.boxes()[box].targets.count;
  }
}

double FmmMobility::Evaluator::node_bytes() const {
  const bool same = sorted_.target.data() == sorted_.position.data();
  return 8.0 * static_cast<double>(sorted_.position.size() + sorted_.force.size() + sorted_.blob.size() +
                                   (same ? 0 : sorted_.target.size()));
}

bool FmmMobility::Evaluator::add(const FmmOptions& options, FmmPlan plan, const double viscosity,
                                 const HostNodes& nodes, const HostVectors& velocity) {
  Stopwatch watch;
  OctreeRules rules;
  rules.leaf_size = plan.leaf_size;
  rules.min_half_width = plan.min_half_width;
  rules.has_quantized_cells = options.far_field == FarField::regularized;
  const int edge = plan.order - 1;
  rules.min_sources_for_expansion = 6 * edge * edge + 2;
  tree_.build(nodes.position, nodes.target, rules);
  tasks_ = make_target_tasks(tree_);
  const BlobRange blobs = range_of(nodes.blob);
  if (options.far_field == FarField::regularized && blobs.smallest != blobs.largest)
    throw Error(
        ExitCode::scene_error,
        fmt::format("far_field = \"regularized\" needs one blob for all nodes, not {:g} .. {:g}: use \"harmonic\"",
                    blobs.smallest, blobs.largest));
  if (options.precision == FmmPrecision::automatic)
    plan.near_in_single &= single_precision_error(blobs.smallest, tree_.largest_leaf()) < options.tolerance;
  count_work(plan);
  statistics.tree_seconds = watch.lap();
  const bool same = nodes.target.data() == nodes.position.data();
  if (options.direct_when_cheaper &&
      estimate_relative_cost(statistics.work, plan, same && blobs.smallest == blobs.largest) > 1.0)
    return false;
  sort_nodes(nodes, regularized_stokeslet::scale(viscosity));
  statistics.sort_seconds = watch.lap();
  if (plan.far_in_single)
    add_in<float>(options, plan, blobs.largest, single_operators_, single_coefficients_, velocity);
  else
    add_in<double>(options, plan, blobs.largest, operators_, coefficients_, velocity);
  return true;
}

FmmMobility::FmmMobility(const double viscosity, const FmmOptions& options)
    : viscosity_(viscosity),
      options_(options),
      direct_(viscosity, Precision::in_double),
      evaluator_(std::make_unique<Evaluator>()) {
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
  pairs_ += static_cast<double>(sources.position.extent(0)) * static_cast<double>(target.extent(0));
  if (!is_checked) {
    add_unchecked(sources, target, velocity);
    return;
  }
  const Vectors own("fmm_velocity", velocity.extent(0));
  while (add_unchecked(sources, target, own)) {
    const double error = compare(sources, target, own, options_.n_checked_targets);
    FmmStatistics& statistics = evaluator_->statistics;
    statistics.checked_error = error;
    ++statistics.n_checks;
    if (!(error > options_.tolerance)) break;  // not a number: the time step finds out and names the node
    ++statistics.n_misses;
    const int order = statistics.plan.order;
    const std::string miss = fmt::format(
        "the fast multipole method at order {} misses tolerance = {:g}: its error at {} checked targets is {:.2g}",
        order, options_.tolerance, options_.n_checked_targets, error);
    const bool is_last = choose_fmm_plan(options_, 0.0, order + 1).order <= order;
    if (options_.on_miss == OnMiss::stop || is_last)
      throw Error(ExitCode::numerical, miss + "; raise the tolerance or use method = \"direct\"");
    statistics.last_miss = miss;
    evaluator_->raised_order = order + 1;
    Kokkos::deep_copy(own, 0.0);
  }
  const Vectors total = velocity;
  Kokkos::parallel_for(
      "skein::add_checked_velocity", Kokkos::RangePolicy<ExecSpace>(0, velocity.extent_int(0)),
      KOKKOS_LAMBDA(const int i) {
        for (int c = 0; c < 3; ++c) total(i, c) += own(i, c);
      });
}

bool FmmMobility::add_unchecked(const Sources& sources, const ConstVectors& target, const Vectors& velocity) {
  evaluator_->statistics.used_direct_sum = true;
  if (options_.direct_when_cheaper) {
    const double n_pairs = static_cast<double>(sources.position.extent(0)) * static_cast<double>(target.extent(0));
    if (n_pairs < min_fmm_pairs || needs_direct_sum(options_)) {
      direct_.add_velocity(sources, target, velocity);
      return false;
    }
  }
  const HostNodes nodes = copy_to_host(sources, target);
  const FmmPlan plan = choose_fmm_plan(options_, range_of(nodes.blob).largest, evaluator_->raised_order);
  bool is_done;
  if constexpr (on_host<ExecSpace>) {
    is_done = evaluator_->add(options_, plan, viscosity_, nodes, velocity);
  } else {
    const auto host_velocity = Kokkos::create_mirror_view_and_copy(Kokkos::HostSpace(), velocity);
    is_done = evaluator_->add(options_, plan, viscosity_, nodes, host_velocity);
    if (is_done) Kokkos::deep_copy(velocity, host_velocity);
  }
  evaluator_->statistics.used_direct_sum = !is_done;
  if (!is_done) direct_.add_velocity(sources, target, velocity);
  return is_done;
}

double FmmMobility::compare(const Sources& sources, const ConstVectors& target, const ConstVectors& velocity,
                            const int n_sample) {
  const int n = target.extent_int(0), n_checked = math::smaller(n, n_sample);
  const Vectors sample("checked_target", n_checked), exact("checked_velocity", n_checked);
  const HostVectors got("fmm_velocity", n_checked);
  const auto host_target = Kokkos::create_mirror_view_and_copy(Kokkos::HostSpace(), target);
  const auto host_velocity = Kokkos::create_mirror_view_and_copy(Kokkos::HostSpace(), velocity);
  const auto host_sample = Kokkos::create_mirror_view(sample);
  for (int i = 0; i < n_checked; ++i) {
    const int from = static_cast<int>((2 * static_cast<std::int64_t>(i) + 1) * n / (2 * n_checked));
    store(host_sample, i, load(host_target, from));
    store(got, i, load(host_velocity, from));
  }
  Kokkos::deep_copy(sample, host_sample);
  direct_.add_velocity(sources, sample, exact);
  const auto host_exact = Kokkos::create_mirror_view_and_copy(Kokkos::HostSpace(), exact);
  double difference = 0.0, size = 0.0;
  for (int i = 0; i < n_checked; ++i) {
    const Vec3 u = load(host_exact, i), d = load(got, i) - u;
    difference += dot(d, d);
    size += dot(u, u);
  }
  return size > 0.0 ? std::sqrt(difference / size) : difference;
}

double FmmMobility::measure_error(const Sources& sources, const ConstVectors& target, const int n_sample) {
  if (sources.position.extent(0) == 0 || target.extent(0) == 0) return 0.0;
  const Vectors own("fmm_velocity", target.extent(0));
  add_unchecked(sources, target, own);
  return compare(sources, target, own, n_sample);
}

std::string FmmMobility::describe() const {
  const char* const field = options_.far_field == FarField::harmonic    ? "harmonic"
                            : options_.far_field == FarField::stokeslet ? "Stokeslet"
                                                                        : "regularized";
  if (options_.direct_when_cheaper && needs_direct_sum(options_))
    return fmt::format("direct sum: tolerance {:g} is below what the fast multipole method promises",
                       options_.tolerance);
  return fmt::format("fast multipole method, {} far field, order {} for tolerance {:g}{}", field,
                     choose_fmm_plan(options_, 0.0, evaluator_->raised_order).order, options_.tolerance,
                     options_.direct_when_cheaper ? "; direct sum where cheaper" : "");
}

}  // namespace skein
