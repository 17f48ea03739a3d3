#pragma once

#include <skein/arrays/sources.hpp>
#include <skein/core/precision.hpp>
#include <skein/physics/node_symmetry.hpp>
#include <skein/physics/symmetric_mobility.hpp>

#include "kernels/stokeslet_images.hpp"

#include <memory>

namespace skein {

/// The host's sum over first nodes and images, and the arrays for it. [n_elements * n_orbits], see ImageMatches
class SymmetricMobility::ImageSum {
 public:
  ImageSum(std::shared_ptr<const NodeSymmetry> symmetry, double viscosity, Precision precision);

  /// True for nodes of one blob that are enough for tiles.
  bool suits(const Sources& sources) const;

  /// Overwrites the velocities of first nodes, but for what is zero by symmetry. @param first_position  [n_orbits, 3]
  void compute(const Sources& sources, const ConstVectors& first_position, const Vectors& first_velocity);

 private:
  template <class Space>
  void fill(const Space& space, const ConstVectorView<Space>& first_position,
            const ConstVectorView<Space>& first_force);
  template <class Space>
  void fold(const Space& space, const VectorView<Space>& first_velocity) const;
  /// A template, so that a GPU build compiles no call of the host's kernel.
  template <class Space>
  void compute_on_host(const Space& space, const Sources& sources, const ConstVectors& first_position,
                       const Vectors& first_velocity);

  std::shared_ptr<const NodeSymmetry> symmetry_;
  double viscosity_;
  Precision precision_;
  ImageMatches matches_;
  HostScalars share_;  ///< [n_orbits]: one over the number of elements that keep a node in place
  HostVectors position_, force_, velocity_;
  HostScalars blob_;
};

}  // namespace skein
