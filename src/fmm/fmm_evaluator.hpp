#pragma once

#include <skein/arrays/combination.hpp>

#include "fmm/coefficient_passes.hpp"
#include "fmm/fmm_choices.hpp"
#include "fmm/operator_store.hpp"
#include "fmm/rank_shares.hpp"
#include "fmm/tail_operators.hpp"
#include "fmm/tree_fit.hpp"
#include "fmm/tree_tasks.hpp"

#include <type_traits>
#include <utility>

namespace skein {

/// An evaluation of the fast multipole method in the memory of Workers::Space: tree, sorted nodes, passes, leaves.
/// Workers say how its loops go through the machine: HostWorkers with a host's vector units, TeamWorkers as plain
/// kernels. Arrays elsewhere are copied; where the caller's are in that memory already they never leave it.
template <class Workers>
class FmmEvaluator final : public FmmSum {
 public:
  using Space = typename Workers::Space;

  /// @param ranks  that share the sum; null: none
  explicit FmmEvaluator(const Workers& workers = Workers(), Communicator* ranks = nullptr)
      : workers_(workers), ranks_(ranks) {
    tree_.defers_counts = Workers::defers_counts;
  }

  bool take(const Sources& sources, const ConstVectors& target) override;
  bool take_part(const Sources& own, const RankParts& parts) override;
  double largest_blob() const override { return blobs_.largest; }
  void begin_step() override { keeping_.begin_step(); }
  void end_step() noexcept override { keeping_.end_step(); }
  bool compute(const FmmOptions& options, const FmmPlan& plan, double viscosity) override;
  void add_to(const Vectors& velocity) const override;
  std::vector<Vec3> sample(const EvenSample& sample) const override;

 private:
  /// What an evaluation in one precision keeps.
  template <class Real>
  struct InPrecision {
    OperatorStore<Real> store;
    OperatorCopies<Space, Real> operators;
    Coefficients<Space, Real> coefficients;
    TailOperators<Real> tail_store;
    OperatorCopies<Space, Real> tail_operators;
    Coefficients<Space, Real> tail_coefficients;
  };

  void require_tree(const OctreeRules& rules, bool may_keep, double scale);
  /// The same of a tree in parts, with its nodes.
  void require_part(const OctreeRules& rules, bool may_keep, double scale);
  void note_new_tree(const OctreeRules& rules);
  /// Of a new tree: who does what, where others take part or each pair is met once.
  void divide_tree(const FmmPlan& plan);
  void sort_nodes(double scale);
  template <class Real>
  void add_in(const FmmOptions& options, const FmmPlan& plan, InPrecision<Real>& in);
  template <class Real, class Field>
  void pass(const FmmPlan& plan, const Field& field, const Levels<Space, Real>& levels,
            Coefficients<Space, Real>& coefficients);
  /// The term of eps^4, which the harmonic field has not: passes of its own without a near field.
  template <class Real>
  void add_tail(const FmmPlan& plan, InPrecision<Real>& in);
  void count_work();
  double lap(LapTimer& watch) const {
    if (times_parts) wait_for(space_);
    return watch.lap();
  }

  Workers workers_;
  Communicator* ranks_;
  Space space_;
  UnsortedNodes<Space> nodes_;
  NodeBounds bounds_;
  BlobRange blobs_{0.0, 0.0};
  VectorView<Space> own_velocity_;
  Octree<Space> tree_;
  TreeKeeping keeping_;
  SortedNodes<Space> sorted_;
  LeafParts<Space> parts_;
  bool is_symmetric_ = false;  ///< sources are targets, with one blob, and each pair is met once
  bool is_divided_ = false;    ///< the tree is
  PassedBoxes boxes_;
  typename Workers::Exchange exchange_;  ///< with other ranks, where there are any
  RankParts given_;                      ///< of nodes, to each rank some; empty: this process has been given all
  bool is_part_ = false;                 ///< the tree is one of several
  InPrecision<double> in_double_;
  InPrecision<float> in_single_;
};

template <class Workers>
bool FmmEvaluator<Workers>::take(const Sources& sources, const ConstVectors& target) {
  given_ = {};
  const typename Space::memory_space memory;
  const auto here = [&](const auto& array) { return Kokkos::create_mirror_view_and_copy(memory, array); };
  nodes_.position = here(sources.position);
  nodes_.force = here(sources.force);
  nodes_.blob = here(sources.blob);
  const bool same = are_same_nodes(sources.position, target);
  nodes_.target = same ? nodes_.position : ConstVectorView<Space>(here(target));
  if (keeping_.has_tree() && !is_part_) tree_.ask_whether_it_fits(space_, nodes_.position, nodes_.target);
  const NodeCensus census = take_census<Space>(space_, nodes_.position, nodes_.target, nodes_.blob);
  bounds_ = census.bounds;
  blobs_ = census.blobs;
  return census.are_finite;
}

template <class Workers>
bool FmmEvaluator<Workers>::compute(const FmmOptions& options, const FmmPlan& chosen, const double viscosity) {
  LapTimer watch;
  FmmPlan plan = chosen;
  const bool is_symmetric =
      Workers::meets_pairs_once && are_same_nodes(nodes_.position, nodes_.target) && blobs_.smallest == blobs_.largest;
  const bool is_part = !given_.count.empty(), may_keep = is_symmetric == is_symmetric_ && is_part == is_part_;
  is_symmetric_ = is_symmetric;
  is_part_ = is_part;
  require_tree(make_octree_rules(options, plan), may_keep, regularized_stokeslet::scale(viscosity));
  settle_plan(options, blobs_, {tree_.half_width(tree_.n_levels() - 1), tree_.largest_leaf}, plan);
  statistics.plan = plan;
  statistics.tree_seconds = lap(watch);
  if (options.direct_when_cheaper && estimate_relative_cost(statistics.work, plan, is_symmetric_, options) > 1.0)
    return false;
  const auto n_targets = static_cast<std::size_t>(tree_.n_targets);
  if (own_velocity_.extent(0) != n_targets)
    own_velocity_ = VectorView<Space>("skein::fmm_evaluator::velocity", n_targets);
  divide_tree(plan);
  if (!is_part_) sort_nodes(regularized_stokeslet::scale(viscosity));
  statistics.sort_seconds = lap(watch);
  if (plan.far_in_single)
    add_in<float>(options, plan, in_single_);
  else
    add_in<double>(options, plan, in_double_);
  if constexpr (Workers::Exchange::makes_parts) {
    if (is_part_) {
      exchange_.return_velocities(given_, owners.count.empty(), own_velocity_);
      return true;
    }
  }
  if (ranks_ != nullptr && owners.count.empty())
    exchange_.gather_velocities(tree_, own_velocity_);
  else if (ranks_ != nullptr)
    exchange_.deliver_velocities(tree_, owners, own_velocity_);
  return true;
}

template <class Workers>
void FmmEvaluator<Workers>::require_tree(const OctreeRules& rules, const bool may_keep, const double scale) {
  if (is_part_) return require_part(rules, may_keep, scale);
  if (may_keep && keeping_.may_serve(rules) && tree_.still_fits()) return;
  tree_.build(space_, nodes_.position, nodes_.target, bounds_, rules);
  note_new_tree(rules);
}

template <class Workers>
void FmmEvaluator<Workers>::note_new_tree(const OctreeRules& rules) {
  if (ranks_ != nullptr && Workers::Exchange::spares_memory) tree_.drop_keys();
  keeping_.note_new_tree(rules);
  ++statistics.n_trees;
  workers_.take(space_, tree_);
  is_divided_ = false;
  count_work();
}

template <class Workers>
void FmmEvaluator<Workers>::divide_tree(const FmmPlan& plan) {
  if (is_divided_) return;
  is_divided_ = true;
  boxes_ = {};
  IndexRange own_targets{0, tree_.n_targets};
  if (ranks_ != nullptr) {
    if constexpr (Workers::Exchange::makes_parts) {
      if (is_part_) exchange_.share_part(tree_, plan, is_symmetric_);
    }
    if (!is_part_) exchange_.share(*ranks_, tree_, plan, is_symmetric_);
    boxes_ = exchange_.boxes();
    own_targets = exchange_.shares().own_targets();
    workers_.take_share(space_, tree_, own_targets);
  }
  if (ranks_ == nullptr)
    for (int level = 0; level < tree_.n_levels(); ++level) boxes_.sources.push_back(tree_.level(level));
  if (ranks_ == nullptr) boxes_.targets = boxes_.sources;
  if constexpr (Workers::meets_pairs_once) {
    if (is_symmetric_)
      workers_.meet_once(tree_, ranks_ == nullptr ? nullptr : &exchange_.shares(),
                         is_part_ ? &exchange_.first_tile() : nullptr);
    else
      workers_.meet_twice();
  }
  if (ranks_ != nullptr && Workers::Exchange::spares_memory) tree_.drop_touching();
  parts_.build(space_, tree_, Workers::part_targets, own_targets);
}

template <class Workers>
void FmmEvaluator<Workers>::sort_nodes(const double scale) {
  require_nodes(tree_, sorted_);
  if (ranks_ == nullptr) {
    skein::sort_nodes<Space>(space_, tree_, nodes_, scale, {0, tree_.n_sources}, {0, tree_.n_targets}, sorted_);
    return;
  }
  // The memory of other places is never touched, so that the system does not give it.
  IndexRange targets = exchange_.shares().own_targets();
  for (const IndexRange run : exchange_.shares().source_runs) {
    skein::sort_nodes<Space>(space_, tree_, nodes_, scale, run, targets, sorted_);
    targets = {};
  }
}

template <class Workers>
template <class Real>
void FmmEvaluator<Workers>::add_in(const FmmOptions& options, const FmmPlan& plan, InPrecision<Real>& in) {
  LapTimer watch;
  const auto& levels =
      in.operators.require(in.store.require(options.far_field, plan, blobs_.largest, tree_), tree_.transfers_met());
  statistics.operators_seconds = watch.lap();
  statistics.far_seconds = statistics.leaf_seconds = 0.0;
  with_far_field(options, blobs_.largest, [&](const auto& field) { pass<Real>(plan, field, levels, in.coefficients); });
  if (plan.tail_degree > 0) add_tail(plan, in);
  double node_bytes = sorted_.bytes(), coefficient_bytes = in.coefficients.bytes() + in.tail_coefficients.bytes();
  if (ranks_ != nullptr && Workers::Exchange::spares_memory) {
    const RankShares& shares = exchange_.shares();
    node_bytes = 56.0 * shares.n_looked_at() + (tree_.same_nodes ? 0.0 : 24.0 * shares.own_targets().count);
    if constexpr (Workers::Exchange::makes_parts) {
      if (is_part_) node_bytes = 56.0 * tree_.n_sources + exchange_.part_bytes();
    }
    coefficient_bytes = sizeof(Real) * shares.n_boxes * (in.coefficients.box_size + in.tail_coefficients.box_size);
  }
  statistics.memory_bytes = in.store.bytes() + in.operators.bytes() + in.tail_store.bytes() +
                            in.tail_operators.bytes() + coefficient_bytes + node_bytes + workers_.bytes() +
                            parts_.bytes() + tree_.bytes();
}

template <class Workers>
template <class Real, class Field>
void FmmEvaluator<Workers>::pass(const FmmPlan& plan, const Field& field, const Levels<Space, Real>& levels,
                                 Coefficients<Space, Real>& coefficients) {
  LapTimer watch;
  coefficients.stride = levels.max_rank_padded;
  coefficients.box_size = Field::n_columns * coefficients.stride;
  const std::size_t needed =
      static_cast<std::size_t>(tree_.n_boxes()) * static_cast<std::size_t>(coefficients.box_size);
  require_extent(coefficients.source, needed, "skein::fmm_evaluator::source_coefficients");
  require_extent(coefficients.target, needed, "skein::fmm_evaluator::target_coefficients");
  const Passes<Space, Real, Field> passes(tree_, sorted_, field, levels, coefficients);
  if constexpr (Workers::Exchange::spares_memory) {
    if (ranks_ != nullptr) boxes_.exchange = [&] { exchange_.exchange_coefficients(coefficients); };
  }
  compute_coefficients(workers_, passes, boxes_);
  statistics.far_seconds += lap(watch);
  with_near_precision<Real>(
      plan, [&](auto near) { workers_.template sum_leaves<decltype(near)>(passes, parts_, own_velocity_); });
  statistics.leaf_seconds += lap(watch);
}

template <class Workers>
template <class Real>
void FmmEvaluator<Workers>::add_tail(const FmmPlan& plan, InPrecision<Real>& in) {
  LapTimer watch;
  const auto sets = in.tail_store.require(plan.tail_degree, tree_.n_levels(), tree_.transfers_met());
  const auto& levels = in.tail_operators.require(sets, tree_.transfers_met());
  statistics.operators_seconds += watch.lap();
  pass<Real>(plan, TailField{plan.tail_degree}, levels, in.tail_coefficients);
}

template <class Workers>
void FmmEvaluator<Workers>::count_work() {
  statistics.n_boxes = tree_.n_boxes();
  statistics.n_levels = tree_.n_levels();
  statistics.n_leaves = tree_.n_target_leaves;
  statistics.smallest_half_width = tree_.half_width(tree_.n_levels() - 1);
  statistics.work.n_sources = static_cast<double>(tree_.n_sources);
  statistics.work.n_targets = static_cast<double>(tree_.n_targets);
  statistics.work.n_boxes = static_cast<double>(tree_.n_boxes());
  statistics.work.far_pairs = static_cast<double>(tree_.v_list.n_entries);
  statistics.work.near_pairs = tree_.n_near_pairs;
  if constexpr (Workers::Exchange::makes_parts) {
    if (is_part_) exchange_.count_whole(given_, statistics);
  }
}

template <class Workers>
void FmmEvaluator<Workers>::add_to(const Vectors& velocity) const {
  VectorView<Space> here = own_velocity_;
  if constexpr (Workers::Exchange::makes_parts) {
    if (is_part_) here = exchange_.velocity();
  }
  if (!is_part_ && !owners.count.empty()) {
    const auto rank = static_cast<std::size_t>(ranks_->rank());
    here = Kokkos::subview(own_velocity_, std::make_pair(owners.first[rank], owners.first[rank] + owners.count[rank]),
                           Kokkos::ALL());
    if constexpr (!std::is_same_v<typename Space::memory_space, ExecSpace::memory_space>) {
      // What goes to another memory has no gaps.
      const VectorView<Space> packed("skein::fmm_evaluator::own_rows", here.extent(0));
      Kokkos::deep_copy(packed, here);
      here = packed;
    }
  }
  const Vectors own = Kokkos::create_mirror_view_and_copy(ExecSpace::memory_space(), here);
  combine<ExecSpace>(ExecSpace(), velocity, {1.0, velocity}, {1.0, own});
}

}  // namespace skein

#include "fmm/fmm_evaluator_parts.hpp"
