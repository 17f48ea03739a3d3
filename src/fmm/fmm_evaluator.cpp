#include "fmm_evaluator.hpp"

#include <skein/arrays/combination.hpp>

#include <string>
#include <type_traits>

namespace skein {
namespace {

void resize(HostVectors& array, const int n, const char* label) {
  if (array.extent_int(0) != n)
    array = HostVectors(Kokkos::view_alloc(std::string(label), Kokkos::WithoutInitializing), n);
}

}  // namespace

bool FmmEvaluator::take(const Sources& sources, const ConstVectors& target) {
  nodes_.position = Kokkos::create_mirror_view_and_copy(Kokkos::HostSpace(), sources.position);
  nodes_.force = Kokkos::create_mirror_view_and_copy(Kokkos::HostSpace(), sources.force);
  nodes_.blob = Kokkos::create_mirror_view_and_copy(Kokkos::HostSpace(), sources.blob);
  const bool same = are_same_nodes(sources.position, target);
  if (same)
    nodes_.target = nodes_.position;
  else
    nodes_.target = Kokkos::create_mirror_view_and_copy(Kokkos::HostSpace(), target);
  blobs_ = find_blob_range<HostSpace>(HostSpace(), nodes_.blob);
  return are_finite<HostSpace>(HostSpace(), nodes_.position) &&
         (same || are_finite<HostSpace>(HostSpace(), nodes_.target));
}

void FmmEvaluator::sort_nodes(const double scale) {
  const HostNodes nodes = nodes_;
  const int n_sources = nodes.position.extent_int(0), n_targets = nodes.target.extent_int(0);
  const bool same = are_same_nodes(nodes.position, nodes.target);
  resize(sorted_.position, n_sources, "skein::fmm_evaluator::sorted_position");
  resize(sorted_.force, n_sources, "skein::fmm_evaluator::sorted_force");
  if (sorted_.blob.extent_int(0) != n_sources)
    sorted_.blob = HostScalars(
        Kokkos::view_alloc(std::string("skein::fmm_evaluator::sorted_blob"), Kokkos::WithoutInitializing), n_sources);
  if (same)
    sorted_.target = sorted_.position;
  else if (sorted_.target.data() == sorted_.position.data() || sorted_.target.extent_int(0) != n_targets)
    sorted_.target = HostVectors(
        Kokkos::view_alloc(std::string("skein::fmm_evaluator::sorted_target"), Kokkos::WithoutInitializing), n_targets);
  const auto sorted = sorted_;
  const auto source_order = tree_.source_order(), target_order = tree_.target_order();
  const auto sort_source = [=](const int i) {
    const int from = source_order(i);
    store(sorted.position, i, load(nodes.position, from));
    store(sorted.force, i, scale * load(nodes.force, from));
    sorted.blob(i) = nodes.blob(from);
  };
  if (ranks_ == nullptr) {
    Kokkos::parallel_for("skein::sort_sources", Kokkos::RangePolicy<HostSpace>(HostSpace(), 0, n_sources), sort_source);
  } else {
    // The memory of other places is never touched, so that the system does not give it.
    const std::vector<IndexRange>& runs = shares_.source_runs;
    Kokkos::parallel_for("skein::sort_sources",
                         Kokkos::RangePolicy<HostSpace>(HostSpace(), 0, static_cast<int>(runs.size())),
                         [&](const int r) {
                           const IndexRange run = runs[static_cast<std::size_t>(r)];
                           for (int i = run.first; i < run.first + run.count; ++i) sort_source(i);
                         });
  }
  const IndexRange targets = ranks_ == nullptr ? IndexRange{0, n_targets} : shares_.own_targets();
  if (!same)
    Kokkos::parallel_for("skein::sort_targets",
                         Kokkos::RangePolicy<HostSpace>(HostSpace(), targets.first, targets.first + targets.count),
                         [=](const int i) { store(sorted.target, i, load(nodes.target, target_order(i))); });
}

template <class Near, class Real, class Field>
void FmmEvaluator::add_leaves(const Field& field, const std::vector<const OperatorSet<Real>*>& levels,
                              const Coefficients<Real>& coefficients) {
  if (!is_symmetric_) {
    const NearField near{tree_.u_list.entries.data(), tree_.u_list.first.data(), tree_.near_end.data(), {}};
    add_leaf_velocities<Near, Real, Field>(tree_, sorted_, field, levels, coefficients, near, tasks_, own_velocity_);
    return;
  }
  if (near_matches_.tiles.empty()) near_matches_ = make_near_matches(tree_, ranks_ == nullptr ? nullptr : &shares_);
  if (ranks_ != nullptr) tree_.drop_touching();
  const int n_packed = near_matches_.n_packed();
  if (near_velocity_.extent_int(0) != 3 * n_packed)
    near_velocity_ =
        HostScalars(Kokkos::view_alloc(std::string("skein::fmm_evaluator::near_velocity"), Kokkos::WithoutInitializing),
                    3 * n_packed);
  if constexpr (std::is_same_v<Near, float>)
    single_near_tiles_.compute(sorted_, near_matches_, near_velocity_);
  else
    near_tiles_.compute(sorted_, near_matches_, near_velocity_);
  const int* first = near_matches_.one_way.first.data();
  const NearField near{near_matches_.one_way.entries.data(), first, first + 1, near_velocity_, n_packed,
                       near_matches_.leaf_first.data()};
  add_leaf_velocities<Near, Real, Field>(tree_, sorted_, field, levels, coefficients, near, tasks_, own_velocity_);
}

template <class Real, class Field>
void FmmEvaluator::pass(const FmmPlan& plan, const Field& field, const std::vector<const OperatorSet<Real>*>& levels,
                        Coefficients<Real>& coefficients) {
  LapTimer watch;
  coefficients.stride = 0;
  for (const auto* level : levels)
    if (level != nullptr) coefficients.stride = math::larger(coefficients.stride, level->rank_padded);
  coefficients.box_size = Field::n_columns * coefficients.stride;
  const std::size_t needed =
      static_cast<std::size_t>(tree_.n_boxes()) * static_cast<std::size_t>(coefficients.box_size);
  if (coefficients.source.extent(0) < needed) {
    coefficients.source = {};  // before the new ones are allocated
    coefficients.target = {};
    coefficients.source = Kokkos::View<Real*, HostSpace>(
        Kokkos::view_alloc(std::string("skein::fmm_evaluator::source_coefficients"), Kokkos::WithoutInitializing),
        needed + needed / 8);
    coefficients.target = Kokkos::View<Real*, HostSpace>(
        Kokkos::view_alloc(std::string("skein::fmm_evaluator::target_coefficients"), Kokkos::WithoutInitializing),
        needed + needed / 8);
  }
  if (ranks_ == nullptr)
    compute_coefficients<Real, Field>(tree_, sorted_, field, levels, coefficients);
  else
    compute_shared_coefficients<Real, Field>(tree_, sorted_, field, levels, coefficients, shares_,
                                             [&] { exchange(coefficients); });
  statistics.far_seconds = watch.lap();
  with_near_precision<Real>(plan, [&](auto near) { add_leaves<decltype(near), Real>(field, levels, coefficients); });
  statistics.leaf_seconds = watch.lap();
}

template <class Real>
void FmmEvaluator::add_in(const FmmOptions& options, const FmmPlan& plan, OperatorStore<Real>& store,
                          Coefficients<Real>& coefficients) {
  LapTimer watch;
  const auto levels = store.require(options.far_field, plan, blobs_.largest, tree_);
  statistics.operators_seconds = watch.lap();
  with_far_field(options, blobs_.largest, [&](const auto& field) { pass<Real>(plan, field, levels, coefficients); });
  double n_coefficients = 2.0 * static_cast<double>(coefficients.source.size());
  if (ranks_ != nullptr) n_coefficients = shares_.n_boxes * coefficients.box_size;
  statistics.memory_bytes = store.bytes() + sizeof(Real) * n_coefficients + node_bytes() + tree_.bytes();
}

void FmmEvaluator::require_tree(const OctreeRules& rules) {
  if (keeping_.may_serve(rules) && tree_.still_fits(HostSpace(), nodes_.position, nodes_.target)) return;
  tree_.build(HostSpace(), nodes_.position, nodes_.target, rules);
  if (ranks_ != nullptr) tree_.drop_keys();
  keeping_.note_new_tree(rules);
  ++statistics.n_trees;
  tasks_ = make_target_tasks(tree_);
  near_matches_ = {};
  has_shares_ = false;
  count_work();
}

void FmmEvaluator::count_work() {
  statistics.n_boxes = tree_.n_boxes();
  statistics.n_levels = tree_.n_levels();
  statistics.n_leaves = tree_.n_target_leaves;
  statistics.smallest_half_width = tree_.half_width(tree_.n_levels() - 1);
  statistics.work.n_sources = static_cast<double>(tree_.n_sources);
  statistics.work.n_targets = static_cast<double>(tree_.n_targets);
  statistics.work.n_boxes = static_cast<double>(tree_.n_boxes());
  statistics.work.far_pairs = static_cast<double>(tree_.v_list.n_entries);
  statistics.work.near_pairs = tree_.n_near_pairs;
}

double FmmEvaluator::node_bytes() const {
  const bool same = sorted_.target.data() == sorted_.position.data();
  const double of_near =
      8.0 * static_cast<double>(near_velocity_.size()) + near_tiles_.bytes() + single_near_tiles_.bytes();
  if (ranks_ != nullptr)
    return 56.0 * shares_.n_looked_at() + (same ? 0.0 : 24.0 * shares_.own_targets().count) + of_near;
  return 8.0 * static_cast<double>(sorted_.position.size() + sorted_.force.size() + sorted_.blob.size() +
                                   (same ? 0 : sorted_.target.size())) +
         of_near;
}

bool FmmEvaluator::compute(const FmmOptions& options, const FmmPlan& chosen, const double viscosity) {
  LapTimer watch;
  FmmPlan plan = chosen;
  require_tree(make_octree_rules(options, plan));
  settle_plan(options, blobs_, tree_.largest_leaf, plan);
  statistics.plan = plan;
  statistics.tree_seconds = watch.lap();
  is_symmetric_ = tree_.same_nodes && blobs_.smallest == blobs_.largest;
  if (options.direct_when_cheaper && estimate_relative_cost(statistics.work, plan, is_symmetric_, options) > 1.0)
    return false;
  if (own_velocity_.extent(0) == nodes_.target.extent(0))
    Kokkos::deep_copy(own_velocity_, 0.0);
  else
    own_velocity_ = HostVectors("skein::fmm_evaluator::fmm_velocity", nodes_.target.extent(0));
  if (ranks_ != nullptr) require_shares(plan);
  sort_nodes(regularized_stokeslet::scale(viscosity));
  statistics.sort_seconds = watch.lap();
  if (plan.far_in_single)
    add_in<float>(options, plan, single_operators_, single_coefficients_);
  else
    add_in<double>(options, plan, operators_, coefficients_);
  if (ranks_ != nullptr) gather_velocities();
  return true;
}

void FmmEvaluator::add_to(const Vectors& velocity) const {
  const Vectors own = Kokkos::create_mirror_view_and_copy(ExecSpace::memory_space(), own_velocity_);
  combine<ExecSpace>(ExecSpace(), velocity, {1.0, velocity}, {1.0, own});
}

std::vector<Vec3> FmmEvaluator::sample(const EvenSample& sample) const {
  return read_sample<HostSpace>(HostSpace(), own_velocity_, sample);
}

}  // namespace skein
