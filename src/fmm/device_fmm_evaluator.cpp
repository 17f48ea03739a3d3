#include "device_fmm_evaluator.hpp"

#include <skein/arrays/combination.hpp>

#include <algorithm>

namespace skein {

bool DeviceFmmEvaluator::take(const Sources& sources, const ConstVectors& target) {
  nodes_ = {sources.position, sources.force, target, sources.blob};
  blobs_ = find_blob_range<ExecSpace>(space_, sources.blob);
  return are_finite<ExecSpace>(space_, sources.position) &&
         (are_same_nodes(sources.position, target) || are_finite<ExecSpace>(space_, target));
}

bool DeviceFmmEvaluator::compute(const FmmOptions& options, const FmmPlan& chosen, const double viscosity) {
  LapTimer watch;
  FmmPlan plan = chosen;
  require_tree(make_octree_rules(options, plan));
  settle_plan(options, blobs_, tree_.largest_leaf, plan);
  statistics.plan = plan;
  space_.fence();
  statistics.tree_seconds = watch.lap();
  // Every pair is met from both sides, by the direct sum on a device, too.
  if (options.direct_when_cheaper && estimate_relative_cost(statistics.work, plan, false, options) > 1.0) return false;
  if (own_velocity_.extent(0) != nodes_.target.extent(0))
    own_velocity_ = Vectors("skein::device_fmm_evaluator::fmm_velocity", nodes_.target.extent(0));
  sort_nodes(space_, tree_, nodes_, regularized_stokeslet::scale(viscosity), sorted_);
  space_.fence();
  statistics.sort_seconds = watch.lap();
  if (plan.far_in_single)
    add_in(options, plan, in_single_);
  else
    add_in(options, plan, in_double_);
  return true;
}

template <class Real>
void DeviceFmmEvaluator::add_in(const FmmOptions& options, const FmmPlan& plan, InPrecision<Real>& in) {
  LapTimer watch;
  const auto& levels =
      in.operators.require(in.store.require(options.far_field, plan, blobs_.largest, tree_), tree_.transfers_met());
  statistics.operators_seconds = watch.lap();
  with_far_field(options, blobs_.largest, [&](const auto& field) { pass<Real>(plan, field, levels, in.coefficients); });
  statistics.memory_bytes =
      in.store.bytes() + in.operators.bytes() +
      sizeof(Real) * static_cast<double>(2 * in.coefficients.source.size() + in.coefficients.products.size()) +
      sorted_.bytes() + tree_.bytes() + far_order_.bytes() + parts_.bytes();
}

template <class Real, class Field>
void DeviceFmmEvaluator::pass(const FmmPlan& plan, const Field& field, const DeviceLevels<ExecSpace, Real>& levels,
                              DeviceCoefficients<ExecSpace, Real>& coefficients) {
  LapTimer watch;
  coefficients.stride = levels.max_rank_padded;
  coefficients.box_size = Field::n_columns * coefficients.stride;
  const std::size_t needed =
      static_cast<std::size_t>(tree_.n_boxes()) * static_cast<std::size_t>(coefficients.box_size);
  require_extent(coefficients.source, needed, "skein::device_fmm_evaluator::source_coefficients");
  require_extent(coefficients.target, needed, "skein::device_fmm_evaluator::target_coefficients");
  const auto box_size = static_cast<std::size_t>(std::max(1, coefficients.box_size));
  const std::size_t n_products = std::clamp(most_product_bytes_ / (sizeof(Real) * box_size), std::size_t{1},
                                            static_cast<std::size_t>(std::max(1, tree_.v_list.n_entries)));
  require_extent(coefficients.products, n_products * box_size, "skein::device_fmm_evaluator::products");
  compute_coefficients_by_teams<ExecSpace, Real, Field>(space_, tree_, far_order_, sorted_, field, levels, coefficients,
                                                        team_size_);
  space_.fence();
  statistics.far_seconds = watch.lap();
  with_near_precision<Real>(plan, [&](auto near) {
    sum_leaf_velocities_by_teams<ExecSpace, decltype(near), Real, Field>(space_, tree_, parts_, sorted_, field, levels,
                                                                         coefficients, own_velocity_, team_size_);
  });
  space_.fence();
  statistics.leaf_seconds = watch.lap();
}

void DeviceFmmEvaluator::require_tree(const OctreeRules& rules) {
  if (keeping_.may_serve(rules) && tree_.still_fits(space_, nodes_.position, nodes_.target)) return;
  tree_.build(space_, nodes_.position, nodes_.target, rules);
  far_order_.build(space_, tree_);
  parts_.build(space_, tree_, part_targets);
  keeping_.note_new_tree(rules);
  ++statistics.n_trees;
  count_work();
}

void DeviceFmmEvaluator::count_work() {
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

void DeviceFmmEvaluator::add_to(const Vectors& velocity) const {
  combine<ExecSpace>(space_, velocity, {1.0, velocity}, {1.0, own_velocity_});
}

std::vector<Vec3> DeviceFmmEvaluator::sample(const EvenSample& sample) const {
  return read_sample<ExecSpace>(space_, own_velocity_, sample);
}

std::unique_ptr<FmmSum> make_device_fmm_sum() { return std::make_unique<DeviceFmmEvaluator>(); }

}  // namespace skein
