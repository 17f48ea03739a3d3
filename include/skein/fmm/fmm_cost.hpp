#pragma once

#include <skein/core/kernel_path.hpp>
#include <skein/fmm/fmm_plan.hpp>

namespace skein {

/// Counts of an evaluation that set its cost.
struct FmmWork {
  double n_sources = 0.0, n_targets = 0.0;
  double near_pairs = 0.0;  ///< of nodes
  double far_pairs = 0.0;   ///< of boxes
  double n_boxes = 0.0;
};

/// To be expected of nodes that lie along lines, such as fibers, as sources and targets.
/// @param length  of all lines together
FmmWork expect_work_along_lines(double n_nodes, double length, const FmmPlan& plan);

/// Of one core, or of a device, for the work of a tree or of a part of it.
double estimate_nanoseconds(const FmmWork& work, const FmmPlan& plan, bool is_symmetric, KernelPath path);

/// Time of an evaluation over that of a direct sum, from measured rates of pairs and products (machine_rates.hpp).
/// @param is_symmetric  sources are targets, with one blob: a host meets each pair once
double estimate_relative_cost(const FmmWork& work, const FmmPlan& plan, bool is_symmetric, const FmmOptions& options);

}  // namespace skein
