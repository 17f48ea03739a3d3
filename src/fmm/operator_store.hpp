#pragma once

#include <skein/fmm/fmm_plan.hpp>

#include "fmm/fmm_operator_set.hpp"
#include "fmm_operators.hpp"

#include <unordered_map>
#include <vector>

namespace skein {

/// Operators kept between calls, for one order and precision.
template <class Real>
class OperatorStore {
 public:
  /// The operators of every level of the tree, complete for its lists.
  /// @param tree  an Octree or a Octree
  template <class Tree>
  std::vector<const OperatorSet<Real>*> require(const FarField far_field, const FmmPlan& plan, const double blob,
                                                const Tree& tree) {
    if (order_ != plan.order || cutoff_ != plan.singular_cutoff) kept_.clear();
    order_ = plan.order;
    cutoff_ = plan.singular_cutoff;
    std::vector<FmmOperators<Real>*> operators;
    for (int level = 0; level < tree.n_levels(); ++level) {
      if (level < first_far_level) {
        operators.push_back(nullptr);
        continue;
      }
      const double ratio = far_field == FarField::regularized ? blob / tree.half_width(level) : 0.0;
      auto found = kept_.find(ratio);
      if (found == kept_.end())
        found =
            kept_.try_emplace(ratio, far_field, plan.order, plan.singular_cutoff, plan.transfer_tolerance, ratio).first;
      operators.push_back(&found->second);
    }
    for (std::size_t level = first_far_level; level < operators.size(); ++level) {
      operators[level]->require_transfers(tree.transfers_met());
      if (level + 1 < operators.size()) operators[level]->require_passes(*operators[level + 1]);
    }
    std::vector<const OperatorSet<Real>*> sets;
    for (const auto* level : operators) sets.push_back(level == nullptr ? nullptr : &level->set());
    return sets;
  }

  double bytes() const {
    double sum = 0.0;
    for (const auto& [ratio, operators] : kept_) sum += operators.bytes();
    return sum;
  }

 private:
  int order_ = 0;
  double cutoff_ = 0.0;
  std::unordered_map<double, FmmOperators<Real>> kept_;  ///< by blob / half-width; one entry where that does not matter
};

}  // namespace skein
