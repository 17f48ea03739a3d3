#pragma once

#include <skein/hydro/fmm_mobility.hpp>
#include <skein/hydro/method_choice.hpp>

#include "kernels/fmm_near_matches.hpp"
#include "kernels/fmm_translations.hpp"
#include "operator_store.hpp"

#include <vector>

namespace skein {

/// Sources and targets in the host's memory; `target` is `position` itself where the sources are the targets.
struct HostNodes {
  ConstVectorView<HostSpace> position, force, target;
  ConstScalarView<HostSpace> blob;
};

struct BlobRange {
  double smallest, largest;
};
BlobRange range_of(const ConstScalarView<HostSpace>& blob);

/// Tree, operators and passes of one evaluation after another.
class FmmEvaluator {
 public:
  /// velocity += the sum after a plan; false, and nothing done, where a direct sum is cheaper and may be used.
  bool add(const FmmOptions& options, FmmPlan plan, double viscosity, const HostNodes& nodes,
           const HostVectors& velocity);

  FmmStatistics statistics;

 private:
  void sort_nodes(const HostNodes& nodes, double scale);
  template <class Real>
  void add_in(const FmmOptions& options, const FmmPlan& plan, double blob, OperatorStore<Real>& store,
              Coefficients<Real>& coefficients, const HostVectors& velocity);
  template <class Real, class Field>
  void pass(const FmmPlan& plan, const Field& field, const std::vector<const OperatorSet<Real>*>& levels,
            Coefficients<Real>& coefficients, const HostVectors& velocity);
  template <class Near, class Real, class Field>
  void add_leaves(const Field& field, const std::vector<const OperatorSet<Real>*>& levels,
                  const Coefficients<Real>& coefficients, const HostVectors& velocity);
  void count_work(const FmmPlan& plan);
  double node_bytes() const;

  Octree tree_;
  SortedNodes sorted_;
  bool is_symmetric_ = false;  ///< sources are targets, with one blob
  HostVectors near_velocity_;
  OperatorStore<double> operators_;
  OperatorStore<float> single_operators_;
  Coefficients<double> coefficients_;
  Coefficients<float> single_coefficients_;
  std::vector<TargetTask> tasks_;
};

}  // namespace skein
