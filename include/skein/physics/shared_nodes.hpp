#pragma once

#include <skein/arrays/node_vectors.hpp>
#include <skein/arrays/sources.hpp>

namespace skein {

struct Physics;

/// The nodes of a run that ranks share: each rank owns those of consecutive sections, and has their rows of every array
/// that is made here. This is rank 0's side, with rank 0's rows; what is done with them by functions of NodeVectors the
/// others do with theirs when the next order reaches them. See docs/hydrodynamics.md, "Ranks".
class SharedNodes : public NodeVectors {
 public:
  /// False where something of the physics is not what ranks know of it, or is not made for parts of arrays: other
  /// forces or another flow than the scene's, a mobility of one process, rigid fibers, a symmetry.
  virtual bool serve(const Physics& physics) const = 0;

  /// True of arrays that were made here.
  virtual bool have_made(const ConstVectors& vectors) const = 0;

  /// Overwrites velocity with the flow at positions, both made here.
  /// @param force  [n_nodes, 3], overwritten with the forces on own nodes: of all only after SumTeam::complete
  /// @returns them with positions, of all nodes after SumTeam::complete
  virtual Sources compute_forces(const Physics& physics, double time, const ConstVectors& position,
                                 const Vectors& velocity, const Vectors& force) = 0;

  /// The same of the change of forces with a displacement of nodes, made here, too; velocity is overwritten with zeros.
  virtual Sources compute_force_changes(const Physics& physics, double time, const ConstVectors& position,
                                        const ConstVectors& displacement, const Vectors& velocity,
                                        const Vectors& force) = 0;

  /// velocity += what the sources do. @param sources, velocity  of one of the two, just before
  virtual void add_velocity(const Physics& physics, const Sources& sources, const Vectors& velocity) = 0;
};

}  // namespace skein
