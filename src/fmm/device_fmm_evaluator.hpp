#pragma once

#include "fmm/device_translations.hpp"
#include "fmm/tree_fit.hpp"
#include "fmm_choices.hpp"
#include "operator_store.hpp"

namespace skein {

/// The evaluation in the memory of the execution space: arrays of nodes and boxes never pass through the host.
/// Operators are made there, and copied when they are first met.
class DeviceFmmEvaluator final : public FmmSum {
 public:
  /// @param team_size           threads of a team, 0: as Kokkos likes; the result does not depend on it
  /// @param most_product_bytes  room for the products of far pairs: every time that it is full, all lists are gone
  ///                            through. Sums are in another order then
  explicit DeviceFmmEvaluator(const int team_size = usual_team_size<ExecSpace>,
                              const std::size_t most_product_bytes = std::size_t{1} << 29)
      : team_size_(team_size), most_product_bytes_(most_product_bytes) {}

  bool take(const Sources& sources, const ConstVectors& target) override;
  double largest_blob() const override { return blobs_.largest; }
  void begin_step() override { keeping_.begin_step(); }
  void end_step() noexcept override { keeping_.end_step(); }
  bool compute(const FmmOptions& options, const FmmPlan& plan, double viscosity) override;
  void add_to(const Vectors& velocity) const override;
  std::vector<Vec3> sample(const EvenSample& sample) const override;

 private:
  template <class Real>
  struct InPrecision {
    OperatorStore<Real> store;
    DeviceOperators<ExecSpace, Real> operators;
    DeviceCoefficients<ExecSpace, Real> coefficients;
  };
  template <class Real>
  void add_in(const FmmOptions& options, const FmmPlan& plan, InPrecision<Real>& in);
  template <class Real, class Field>
  void pass(const FmmPlan& plan, const Field& field, const DeviceLevels<ExecSpace, Real>& levels,
            DeviceCoefficients<ExecSpace, Real>& coefficients);
  void require_tree(const OctreeRules& rules);
  void count_work();

  ExecSpace space_;
  int team_size_;
  std::size_t most_product_bytes_;
  UnsortedNodes<ExecSpace> nodes_;
  BlobRange blobs_{0.0, 0.0};
  Octree<ExecSpace> tree_;
  FarOrder<ExecSpace> far_order_;
  LeafParts<ExecSpace> parts_;
  TreeKeeping keeping_;
  DeviceNodes<ExecSpace> sorted_;
  InPrecision<double> in_double_;
  InPrecision<float> in_single_;
  Vectors own_velocity_;
};

}  // namespace skein
