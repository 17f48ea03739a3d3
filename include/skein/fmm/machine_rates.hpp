#pragma once

#include <skein/core/kernel_path.hpp>
#include <skein/core/precision.hpp>

namespace skein {

/// Of pairs or products in both precisions, ns.
struct RateByPrecision {
  double in_double, in_single;
  double of(const bool is_single) const { return is_single ? in_single : in_double; }
};

/// What sums cost on one kind of machine, as measured: methods, precisions and leaves are chosen by it. A choice
/// follows from the scene and the kind, never from the machine at hand, so that a run can be repeated. Times are
/// nanoseconds; a host's are of one core with wide vectors, where only their ratios matter.
struct MachineRates {
  const char* measured_on;  ///< machine, command, date

  RateByPrecision direct_pair;            ///< of direct sums
  RateByPrecision symmetric_direct_pair;  ///< the same where each pair is met once for both of its nodes
  double direct_sum;                      ///< however few its pairs
  RateByPrecision near_pair, symmetric_near_pair;
  RateByPrecision surface_pair;  ///< of a node and a point of a box's surface
  RateByPrecision product;       ///< per multiplication and addition of translations, times two
  double transfer_work;          ///< of thin factors, over that of the whole matrix
  double node;                   ///< tree and sorting, for a source or a target
  double tree;                   ///< however few its nodes

  double least_fmm_nodes;    ///< fewer are summed directly before a tree is built
  int least_leaf_size;       ///< nodes in a leaf, if the tables of orders ask for fewer
  double least_single_gain;  ///< direct sums are single where that is so many times faster, and the tolerance allows it

  /// Of a direct sum. @param meets_once  each pair, for both of its nodes
  double direct_nanoseconds(const bool meets_once, const bool is_single, const double n_pairs) const {
    return direct_sum + (meets_once ? symmetric_direct_pair : direct_pair).of(is_single) * n_pairs;
  }
};

/// @param path  automatic: where this build's kernels run
const MachineRates& machine_rates(KernelPath path);

/// Of direct sums that a tolerance is asked of: single where that is good enough and pays.
Precision choose_direct_precision(const MachineRates& rates, double n_pairs, double tolerance);

}  // namespace skein
