#pragma once

#include <skein/core/kernel_path.hpp>
#include <skein/core/precision.hpp>
#include <skein/physics/mobility.hpp>

namespace skein {

class SumTeam;

/// The regularized Stokeslets of all sources, summed pair by pair: O(n_sources n_targets), exact to rounding in double,
/// to about 1e-6 in single precision (positions, differences and long sums stay double). Sums repeat to the bit on one
/// machine; devices that run other numbers of threads at once cut them up otherwise.
class DirectMobility final : public Mobility {
 public:
  /// @param viscosity  > 0, force * time / length^2
  /// @param precision  automatic: double
  /// @param team       ranks that share the sums, which have another order then; null: none
  DirectMobility(double viscosity, Precision precision, KernelPath path = KernelPath::automatic,
                 SumTeam* team = nullptr);

  void add_velocity(const Sources& sources, const ConstVectors& target, const Vectors& velocity) override;
  bool sums_by_ranks() const override { return team_ != nullptr; }
  double expected_error() const override { return precision_ == Precision::in_single ? 1e-6 : 0.0; }
  double relative_cost(const NodeLines& nodes) const override;
  double pairs() const override { return pairs_; }
  std::string describe() const override;
  void visit_memory(MemoryVisitor&) override {}

 private:
  double viscosity_;
  Precision precision_;
  bool by_teams_;
  SumTeam* team_;
  Scalars partial_;  ///< scratch of the teams
  double pairs_ = 0.0;
};

}  // namespace skein
