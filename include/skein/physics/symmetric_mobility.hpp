#pragma once

#include <skein/core/precision.hpp>
#include <skein/physics/direct_mobility.hpp>
#include <skein/physics/node_symmetry.hpp>

#include <memory>

namespace skein {

/// The direct sum of a scene with a symmetry: velocities are found for the first nodes of orbits, from their forces and
/// the images of these, and mapped to all others. On hosts each pair of a node and an image is weighed once for both;
/// on devices, of few nodes and of unlike blobs, all nodes are sources and the first ones targets.
///
/// Forces must be as symmetric as the nodes are: those of nodes that are not first are not looked at, or make
/// velocities that are those of a symmetric scene all the same. Where targets are not the nodes, the sum is that of all
/// nodes.
class SymmetricMobility final : public Mobility {
 public:
  /// @param viscosity  > 0, force * time / length^2
  /// @param precision  automatic: double
  SymmetricMobility(double viscosity, Precision precision, std::shared_ptr<const NodeSymmetry> symmetry);
  ~SymmetricMobility() override;

  void add_velocity(const Sources& sources, const ConstVectors& target, const Vectors& velocity) override;
  double pairs() const override { return pairs_ + direct_.pairs(); }
  std::string describe() const override;
  void visit_memory(MemoryVisitor&) override {}

 private:
  struct Copies;

  /// Each pair of a node and an image once, where that can be. @returns false where not
  /// A template, so that a GPU build compiles no call of the host's kernel.
  template <class Space>
  bool try_images(const Space& space, const Sources& sources);

  double viscosity_;
  Precision precision_;
  std::shared_ptr<const NodeSymmetry> symmetry_;
  DirectMobility direct_;
  Vectors first_position_, first_velocity_;  ///< [n_orbits, 3]
  std::unique_ptr<Copies> copies_;
  double pairs_ = 0.0;
};

}  // namespace skein
