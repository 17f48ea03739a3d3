#pragma once

#include <skein/fmm/fmm_plan.hpp>
#include <skein/fmm/fmm_sum.hpp>
#include <skein/physics/direct_mobility.hpp>
#include <skein/physics/mobility.hpp>

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace skein {

class SumTeam;

/// The regularized Stokeslets of all sources by a kernel-independent fast multipole method: O(n) for a stated error.
///
/// Near nodes are summed with S_eps of each source's own blob; far ones through an adaptive octree (see FarField for
/// the approximations). Operators are kept, and the tree for as long in a time step as the nodes stay close to their
/// leaves. KernelPath says where it runs. A node whose position is not finite makes all velocities not a number, as in
/// a direct sum. Source: Ying, Biros, Zorin, J. Comput. Phys. 196, 591 (2004).
class FmmMobility final : public Mobility {
 public:
  /// @param viscosity  > 0, force * time / length^2
  /// @throws Error(scene_error) where the options ask for what cannot be delivered.
  /// @param team  ranks that share the sums, to the same bits; null: none
  FmmMobility(double viscosity, const FmmOptions& options, SumTeam* team = nullptr);
  ~FmmMobility() override;

  /// @throws Error(scene_error) where a tolerance is out of reach for these blobs; Error(numerical) where a check finds
  /// an error above the tolerance and the options say to stop.
  void add_velocity(const Sources& sources, const ConstVectors& target, const Vectors& velocity) override;
  void begin_step() override { sum_->begin_step(); }
  void end_step() noexcept override { sum_->end_step(); }
  bool sums_by_ranks() const override { return team_ != nullptr; }
  double expected_error() const override { return options_.tolerance; }
  double relative_cost(const NodeLines& nodes) const override;
  double pairs() const override { return pairs_; }
  std::string describe() const override;
  void visit_memory(MemoryVisitor& visitor) override;
  ErrorRecord error_record() const override { return record_; }
  std::vector<std::string> take_messages() override;

  /// Relative error (2-norm) of one evaluation against direct sums at n_sample targets, evenly spread over the indices.
  double measure_error(const Sources& sources, const ConstVectors& target, int n_sample);

  const FmmStatistics& statistics() const;
  /// Whether from here on the seconds in the statistics are those of the parts: on hosts they are, on devices that
  /// takes some waiting.
  void time_parts(bool on = true);

 private:
  FmmTargets place_of(const Sources& sources, const ConstVectors& target) const;
  /// True where direct sums are the rule for so many pairs, before a tree is built.
  bool sums_directly(double n_pairs, FmmTargets targets) const;
  /// That stands in for the method, in the precision that the machine and the tolerance suggest.
  bool sums_directly_in_single(double n_pairs) const;
  DirectMobility& direct_sum_of(const double n_pairs) {
    return sums_directly_in_single(n_pairs) ? direct_in_single_ : direct_;
  }
  /// Computes the sum of the arrays that were taken; false where a direct sum is cheaper.
  bool evaluate(FmmTargets targets);
  /// False where the sum, which is to be added to `velocity`, missed the tolerance, and the order is raised now.
  bool passes_check(const Sources& sources, const ConstVectors& target, const Vectors& velocity);
  /// Some checks after the order was raised, a lower one is tried. True where it has met the tolerance with room to
  /// spare: it is taken, and its sum is there.
  bool lowers_order(const Sources& sources, const ConstVectors& target, FmmTargets targets);
  void note_check(double error);
  /// The sum is added to the velocities.
  void use_sum(const Vectors& velocity);

  static constexpr std::int64_t first_lowering_wait = 8;

  double viscosity_;
  FmmOptions options_;
  SumTeam* team_;
  DirectMobility direct_, direct_in_single_;
  std::unique_ptr<FmmSum> sum_;
  double pairs_ = 0.0;
  int raised_order_ = 0;                              ///< that a check found necessary; 0: as planned
  std::int64_t next_lowering_ = 0;                    ///< number of checks at which a lower one is tried
  std::int64_t lowering_wait_ = first_lowering_wait;  ///< checks from one try to the next
  std::int64_t n_evaluations_ = 0;                    ///< decides which are checked
  ErrorRecord record_;
  std::vector<std::string> messages_;
};

}  // namespace skein
