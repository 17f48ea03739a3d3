#include <skein/fmm/fmm_cost.hpp>
#include <skein/fmm/machine_rates.hpp>

#include <algorithm>

namespace skein {

FmmWork expect_work_along_lines(const double n_nodes, const double length, const FmmPlan& plan) {
  // Each level halves the lines. A leaf meets itself and a neighbour at either end; a box the children of its parent's
  // neighbours but for its own, of which half have two and half four on the two sides.
  const double leaf_nodes = std::max<double>(plan.leaf_size, n_nodes * 2.0 * plan.min_half_width / length);
  const double n_leaves = std::max(1.0, n_nodes / leaf_nodes), n_boxes = 2.0 * n_leaves;
  return {n_nodes, n_nodes, n_nodes * std::min(n_nodes, 3.0 * leaf_nodes), 3.0 * n_boxes, n_boxes};
}

double estimate_nanoseconds(const FmmWork& work, const FmmPlan& plan, const bool is_symmetric, const KernelPath path) {
  const MachineRates& rates = machine_rates(path);
  const double near_pair = (is_symmetric ? rates.symmetric_near_pair : rates.near_pair).of(plan.near_in_single);
  const double n_surface = 6.0 * (plan.order - 1) * (plan.order - 1) + 2.0;
  const double rank = plan.rank;
  const double n_nodes = work.n_sources + work.n_targets;
  // Of the tail a node costs about a surface point for each polynomial, and transfers hardly anything.
  const double degree = plan.tail_degree;
  const double n_polynomials = plan.tail_degree > 0 ? (degree + 1.0) * (degree + 2.0) * (degree + 3.0) / 6.0 : 0.0;
  return near_pair * work.near_pairs +
         rates.surface_pair.of(plan.far_in_single) * (n_surface + n_polynomials) * n_nodes +
         8.0 * rates.product.of(plan.far_in_single) *
             (rank * rank * (rates.transfer_work * work.far_pairs + 2.0 * work.n_boxes) +
              (2.0 * rank * n_surface + 4.5 * n_polynomials * n_polynomials) * work.n_boxes) +
         rates.node * n_nodes;
}

double estimate_relative_cost(const FmmWork& work, const FmmPlan& plan, const bool is_symmetric,
                              const FmmOptions& options) {
  const MachineRates& rates = machine_rates(options.path);
  // Where no boxes are far from each other there are no expansions either.
  const FmmWork near_only{.near_pairs = work.near_pairs};
  const double sum = work.far_pairs > 0.0 ? estimate_nanoseconds(work, plan, is_symmetric, options.path)
                                          : estimate_nanoseconds(near_only, plan, is_symmetric, options.path) +
                                                rates.node * (work.n_sources + work.n_targets);
  const double fmm = sum + rates.tree;
  const double n_pairs = work.n_sources * work.n_targets;
  const Precision precision = options.precision == Precision::automatic
                                  ? choose_direct_precision(rates, n_pairs, options.tolerance)
                                  : options.precision;
  return fmm / rates.direct_nanoseconds(is_symmetric, precision == Precision::in_single, n_pairs);
}

}  // namespace skein
