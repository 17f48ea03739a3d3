#pragma once

#include <skein/core/precision.hpp>
#include <skein/fmm/fmm_plan.hpp>
#include <skein/physics/mobility.hpp>
#include <skein/physics/node_symmetry.hpp>

#include <memory>
#include <string>
#include <vector>

namespace skein {

class SumTeam;

/// Velocities of a scene with a symmetry: they are found for the first nodes of orbits, and mapped to all others.
///
/// Direct sums weigh, on hosts and with equal blobs, each pair of a first node and an image once for both. Elsewhere,
/// and by the fast multipole method, all nodes are sources and the first ones targets. Forces and positions must be as
/// symmetric as the scene; of those of other nodes than the first it is left open whether they are looked at. Where
/// targets are not the nodes, velocities are those of all nodes as they are.
class SymmetricMobility final : public Mobility {
 public:
  /// By direct sums. @param viscosity  > 0, force * time / length^2  @param precision  automatic: double
  /// @param team  ranks that share the sums, in which each pair is weighed from both sides then; null: none
  SymmetricMobility(double viscosity, Precision precision, std::shared_ptr<const NodeSymmetry> symmetry,
                    SumTeam* team = nullptr);

  /// By the fast multipole method. @throws Error(scene_error) where the options ask for what cannot be delivered
  SymmetricMobility(double viscosity, const FmmOptions& options, std::shared_ptr<const NodeSymmetry> symmetry,
                    SumTeam* team = nullptr);
  ~SymmetricMobility() override;

  void add_velocity(const Sources& sources, const ConstVectors& target, const Vectors& velocity) override;
  void begin_step() override { at_nodes_->begin_step(); }
  void end_step() noexcept override { at_nodes_->end_step(); }
  double relative_cost(const NodeLines& nodes) const override;
  double pairs() const override { return pairs_ + elsewhere_->pairs(); }
  std::string describe() const override;
  void visit_memory(MemoryVisitor& visitor) override { at_nodes_->visit_memory(visitor); }
  ErrorRecord error_record() const override { return at_nodes_->error_record(); }
  std::vector<std::string> take_messages() override;

 private:
  class ImageSum;

  SymmetricMobility(std::shared_ptr<const NodeSymmetry> symmetry, std::unique_ptr<Mobility> at_nodes,
                    std::unique_ptr<Mobility> elsewhere, double gain);
  /// Each pair of a node and an image once, where that can be. @returns false where not
  bool try_images(const Sources& sources);
  /// Overwrites first_velocity_. @param velocity  that the sum is to be added to
  void compute_at_first_nodes(const Sources& sources, const ConstVectors& velocity);

  std::shared_ptr<const NodeSymmetry> symmetry_;
  std::unique_ptr<Mobility> at_nodes_, elsewhere_;    ///< sums over all nodes, for first ones and for other targets
  std::unique_ptr<ImageSum> images_;                  ///< null: not by direct sums on a host
  Vectors first_position_, first_velocity_, before_;  ///< [n_orbits, 3]
  double gain_;                                       ///< by what the symmetry makes the sums over nodes faster
  double pairs_ = 0.0;
  bool was_elsewhere_ = false;  ///< the last sum, which is the one to describe
};

}  // namespace skein
