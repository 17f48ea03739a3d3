#pragma once

#include "fmm/near_tiles.hpp"
#include "fmm/tree_fit.hpp"
#include "fmm_choices.hpp"
#include "operator_store.hpp"

#include <vector>

namespace skein {

/// Sources and targets in the host's memory; `target` is `position` itself where the sources are the targets.
struct HostNodes {
  ConstVectorView<HostSpace> position, force, target;
  ConstScalarView<HostSpace> blob;
};

/// The evaluation on the host, with its vector units; device arrays are copied.
class FmmEvaluator final : public FmmSum {
 public:
  /// @param ranks  that share the sum; null: none
  explicit FmmEvaluator(Communicator* ranks) : ranks_(ranks) {}

  bool take(const Sources& sources, const ConstVectors& target) override;
  double largest_blob() const override { return blobs_.largest; }
  void begin_step() override { keeping_.begin_step(); }
  void end_step() noexcept override { keeping_.end_step(); }
  bool compute(const FmmOptions& options, const FmmPlan& plan, double viscosity) override;
  void add_to(const Vectors& velocity) const override;
  std::vector<Vec3> sample(const EvenSample& sample) const override;

 private:
  void sort_nodes(double scale);
  template <class Real>
  void add_in(const FmmOptions& options, const FmmPlan& plan, OperatorStore<Real>& store,
              Coefficients<Real>& coefficients);
  template <class Real, class Field>
  void pass(const FmmPlan& plan, const Field& field, const std::vector<const OperatorSet<Real>*>& levels,
            Coefficients<Real>& coefficients);
  template <class Near, class Real, class Field>
  void add_leaves(const Field& field, const std::vector<const OperatorSet<Real>*>& levels,
                  const Coefficients<Real>& coefficients);
  void require_tree(const OctreeRules& rules);
  /// Divides a new tree, or one that others than before are to be had from.
  void require_shares(const FmmPlan& plan);
  template <class Real>
  void exchange(const Coefficients<Real>& coefficients);
  /// Own targets' velocities to rank 0.
  void gather_velocities();
  void count_work();
  double node_bytes() const;

  Communicator* ranks_;
  HostNodes nodes_;
  BlobRange blobs_{0.0, 0.0};
  HostVectors own_velocity_;
  HostOctree tree_;
  TreeKeeping keeping_;
  SortedNodes sorted_;
  bool is_symmetric_ = false;  ///< sources are targets, with one blob
  NearTiles<double> near_tiles_;
  NearTiles<float> single_near_tiles_;
  HostScalars near_velocity_;
  OperatorStore<double> operators_;
  OperatorStore<float> single_operators_;
  Coefficients<double> coefficients_;
  Coefficients<float> single_coefficients_;
  std::vector<TargetTask> tasks_;
  std::vector<double> send_, receive_;  ///< to and from other ranks
  RankShares shares_;                   ///< of the tree; n_ranks 1 without others
  bool has_shares_ = false;
  NearMatches near_matches_;  ///< of the tree, once they were needed
};

}  // namespace skein
