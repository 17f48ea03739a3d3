#include "fmm_evaluator.hpp"

#include <skein/core/error.hpp>
#include <skein/core/stopwatch.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <utility>

namespace skein {
namespace {

/// Seconds since the lap before.
class LapTimer {
 public:
  double lap() {
    const auto since = std::exchange(start_, WallClock::now());
    return std::chrono::duration<double>(start_ - since).count();
  }

 private:
  WallClock::time_point start_ = WallClock::now();
};

void resize(HostVectors& array, const int n, const char* label) {
  if (array.extent_int(0) != n)
    array = HostVectors(Kokkos::view_alloc(std::string(label), Kokkos::WithoutInitializing), n);
}

}  // namespace

BlobRange range_of(const ConstScalarView<HostSpace>& blob) {
  BlobRange range{blob(0), blob(0)};
  for (int i = 1; i < blob.extent_int(0); ++i) {
    range.smallest = std::min(range.smallest, blob(i));
    range.largest = std::max(range.largest, blob(i));
  }
  return range;
}

void FmmEvaluator::sort_nodes(const HostNodes& nodes, const double scale) {
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

template <class Near, class Real, class Field>
void FmmEvaluator::add_leaves(const Field& field, const std::vector<const OperatorSet<Real>*>& levels,
                              const Coefficients<Real>& coefficients, const HostVectors& velocity) {
  if (!is_symmetric_) {
    add_leaf_velocities<Near, Real, Field>(tree_, sorted_, field, levels, coefficients, {tree_.near_sources(), {}},
                                           tasks_, velocity);
    return;
  }
  resize(near_velocity_, sorted_.target.extent_int(0), "near_velocity");
  compute_near_velocities<Near>(sorted_, make_near_matches(tree_), near_velocity_);
  add_leaf_velocities<Near, Real, Field>(tree_, sorted_, field, levels, coefficients,
                                         {tree_.one_way_sources(), near_velocity_}, tasks_, velocity);
}

template <class Real, class Field>
void FmmEvaluator::pass(const FmmPlan& plan, const Field& field, const std::vector<const OperatorSet<Real>*>& levels,
                        Coefficients<Real>& coefficients, const HostVectors& velocity) {
  LapTimer watch;
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
      add_leaves<float, Real>(field, levels, coefficients, velocity);
    else
      add_leaves<double, Real>(field, levels, coefficients, velocity);
  } else {
    add_leaves<double, Real>(field, levels, coefficients, velocity);
  }
  statistics.leaf_seconds = watch.lap();
}

template <class Real>
void FmmEvaluator::add_in(const FmmOptions& options, const FmmPlan& plan, const double blob, OperatorStore<Real>& store,
                          Coefficients<Real>& coefficients, const HostVectors& velocity) {
  LapTimer watch;
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

void FmmEvaluator::count_work(const FmmPlan& plan) {
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

double FmmEvaluator::node_bytes() const {
  const bool same = sorted_.target.data() == sorted_.position.data();
  return 8.0 * static_cast<double>(sorted_.position.size() + sorted_.force.size() + sorted_.blob.size() +
                                   (same ? 0 : sorted_.target.size()));
}

bool FmmEvaluator::add(const FmmOptions& options, FmmPlan plan, const double viscosity, const HostNodes& nodes,
                       const HostVectors& velocity) {
  LapTimer watch;
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
  is_symmetric_ = tree_.has_same_nodes() && blobs.smallest == blobs.largest;
  if (options.direct_when_cheaper && estimate_relative_cost(statistics.work, plan, is_symmetric_) > 1.0) return false;
  sort_nodes(nodes, regularized_stokeslet::scale(viscosity));
  statistics.sort_seconds = watch.lap();
  if (plan.far_in_single)
    add_in<float>(options, plan, blobs.largest, single_operators_, single_coefficients_, velocity);
  else
    add_in<double>(options, plan, blobs.largest, operators_, coefficients_, velocity);
  return true;
}

}  // namespace skein
