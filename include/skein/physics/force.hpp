#pragma once

#include <skein/arrays/types.hpp>
#include <skein/core/symmetric_tensor.hpp>
#include <skein/core/time_course.hpp>
#include <skein/fibers/fiber.hpp>

#include <limits>
#include <string>
#include <vector>

namespace skein {

/// What a force promises. Tests hold every force to its promises, and what reads forces asks for them instead of for
/// kinds.
struct ForcePromises {
  bool is_balanced = false;           ///< its sum over all nodes is zero
  bool is_torque_free = false;        ///< its torque about any point is zero
  bool is_conservative = false;       ///< it is minus the gradient of its energy at every moment
  bool is_steady = false;             ///< it does not depend on time
  bool is_frame_indifferent = false;  ///< nodes that move as a rigid body carry it with them
  bool acts_between_fibers = false;   ///< one fiber may take from it what another gives
  /// The force on a section, and its change, depend on nodes of sections of the same fiber up to so far from it only.
  int reach = everywhere;
  static constexpr int everywhere = -1;  ///< on any
  bool sees_centroids = false;           ///< besides, on the centroids of any sections
};

/// Nodes as a rank sees them, for the forces on some of them. [n_nodes, 3] and [n_sections, 3], length
struct SeenNodes {
  ConstVectors position;           ///< of nodes within reach; others' are not looked at
  ConstVectors centroid;           ///< of all sections; empty: position is of all nodes
  ConstVectors displacement;       ///< of nodes within reach; empty: forces are asked for, not changes of them
  ConstVectors mean_displacement;  ///< of the nodes of each section; empty: displacement is of all nodes
};

/// What acts on nodes besides the fluid: springs, a repulsion, gravity, ... A scene's forces are a list of these
/// (see physics.hpp), and each has a row in tests/property/test_force.cpp.
///
/// Forces are those of the nodes ON the fluid. Positions, displacements, velocities and forces are [n_nodes, 3]; calls
/// return before a device has finished, and results do not depend on the number of threads. One call at a time: objects
/// hold scratch. @throws Error(internal) where extents are not those of the fibers
class Force {
 public:
  virtual ~Force() = default;

  virtual ForcePromises promises() const = 0;

  /// Adds the force on each node. @param position  length
  virtual void add_forces(double time, const ConstVectors& position, const Vectors& force) const = 0;

  /// The same in place of what was in `force`: the first of several does this.
  virtual void compute_forces(const double time, const ConstVectors& position, const Vectors& force) const {
    Kokkos::deep_copy(ExecSpace(), force, 0.0);
    add_forces(time, position, force);
  }

  /// Adds the first-order change of these forces when nodes move by `displacement`, length.
  virtual void add_force_changes(double time, const ConstVectors& position, const ConstVectors& displacement,
                                 const Vectors& change) const = 0;

  /// The same two for the nodes [first, first + n): these get the same bits; of the others' numbers nothing is said.
  /// Ranks share the forces of a scene by them. A force that has no way for a few nodes does it for all.
  virtual void add_forces_on(int /*first*/, int /*n*/, const double time, const SeenNodes& nodes,
                             const Vectors& force) const {
    add_forces(time, nodes.position, force);
  }
  virtual void add_force_changes_on(int /*first*/, int /*n*/, const double time, const SeenNodes& nodes,
                                    const Vectors& change) const {
    add_force_changes(time, nodes.position, nodes.displacement, change);
  }

  /// Launches the search for its energies and for the largest strain of its bonds, which are there after the next wait
  /// for the device: several forces have one wait.
  virtual void seek_measures(double /*time*/, const ConstVectors& /*position*/) const {}
  /// Adds the energies that were sought last, force * length; halves of what two fibers share. A force that has none
  /// adds nothing. @param energy  [n_fibers]
  virtual void add_found_energies(std::vector<double>& /*energy*/) const {}
  /// The largest relative change of length of its bonds that was sought last; 0 for a force without bonds.
  virtual double found_largest_strain() const { return 0.0; }

  /// The same for one force by itself. Wait for the device.
  void add_energies(double time, const ConstVectors& position, std::vector<double>& energy) const;
  double compute_largest_strain(const ConstVectors& position) const;

  /// Adds the power that comes from outside: of forces without an energy, force . velocity; of an energy that changes
  /// with time, its rate at fixed positions. Force * length / time. A steady conservative force adds nothing.
  /// @param velocity  of the nodes, length / time  @param power  [n_fibers]
  virtual void add_drive_powers(double /*time*/, const ConstVectors& /*position*/, const ConstVectors& /*velocity*/,
                                std::vector<double>& /*power*/) const {}

  /// Adds the symmetric part of the first moment of its forces, sum of (x - centroid of the fiber) f, for each fiber:
  /// what particle stress is made of. A force between fibers may count arms between them instead. Force * length
  /// @param moment  [n_fibers]
  virtual void add_moments(const std::vector<Fiber>& fibers, double time, const ConstVectors& position,
                           std::vector<SymmetricTensor>& moment) const;

  /// Time in which it carries a fiber by the fiber's length, or turns it around; infinite for a force that moves
  /// nothing but what something else has moved, such as springs.
  virtual double time_scale() const { return std::numeric_limits<double>::infinity(); }

  /// Adds when it changes by itself; nothing of a steady force.
  virtual void add_course(TimeCourse& /*course*/) const {}

  /// One line for the first lines of a run.
  virtual std::string describe() const = 0;
};

}  // namespace skein
