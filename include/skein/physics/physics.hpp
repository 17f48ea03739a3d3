#pragma once

#include <skein/fibers/fiber.hpp>
#include <skein/physics/background_flow.hpp>
#include <skein/physics/force.hpp>
#include <skein/physics/mobility.hpp>
#include <skein/physics/node_symmetry.hpp>
#include <skein/physics/rigid_bodies.hpp>
#include <skein/physics/sections.hpp>
#include <skein/scene/scene_config.hpp>

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace skein {

class SharedForces;
class SharedNodes;
class SumTeam;

/// See Physics::measure.
struct StepMeasures {
  SectionRecord sections;
  std::vector<double> energy;   ///< [n_fibers], as compute_energies
  double largest_strain = 0.0;  ///< of bonds, over all forces
};

/// All that a scene says of the world, ready to be asked: fibers, the forces on their nodes, the flow and the fluid.
/// Runs, analyses, benches and users of the library make it by make_physics, and may replace its parts before it is
/// used.
struct Physics {
  std::vector<Fiber> fibers;
  std::vector<std::unique_ptr<Force>> forces;  ///< in the order in which they are added up; springs first
  std::unique_ptr<BackgroundFlow> flow;
  std::unique_ptr<Mobility> mobility;
  RigidBodies rigid_bodies;                      ///< those of the fibers that are rigid
  Sections sections;                             ///< of the fibers
  Scalars blob;                                  ///< [n_nodes], length
  double viscosity = 1.0;                        ///< force * time / length^2
  std::shared_ptr<const NodeSymmetry> symmetry;  ///< that velocities keep; null: none
  std::shared_ptr<SharedForces> shared_forces;   ///< with ranks; null: none. Forces put in by others are not shared
  std::shared_ptr<SharedNodes> shared_nodes;     ///< that ranks own parts of; null: none

  /// Nodes at the start, of which those of a symmetric scene are images of each other to the last bit.
  /// @param seed  of random bends  @returns [n_nodes], length
  std::vector<Vec3> make_start_nodes(std::uint64_t seed) const;

  /// Overwrites force, [n_nodes, 3], with the sum of all forces on each node; what keeps fibers rigid is not among
  /// them.
  void compute_forces(double time, const ConstVectors& position, const Vectors& force) const;

  /// Overwrites change, [n_nodes, 3], with the first-order change of the forces when nodes move by `displacement`.
  void compute_force_changes(double time, const ConstVectors& position, const ConstVectors& displacement,
                             const Vectors& change) const;

  /// Of all forces that have one, force * length. Waits for the device. @returns [n_fibers]
  std::vector<double> compute_energies(double time, const ConstVectors& position) const;

  /// What the record of a step says of its end. One wait for the device.
  StepMeasures measure(double time, const ConstVectors& position) const;

  /// True where some force acts between fibers, such as one that keeps them apart.
  bool has_force_between_fibers() const;

  /// The scene's own time, by which steps and tolerances are measured: the shortest in which the flow or a force moves
  /// fibers; where nothing moves them, that in which a bend of the quickest fiber relaxes.
  double time_scale() const;

  /// Of the sum in a velocity, see Mobility::relative_cost.
  double relative_sum_cost() const;

  /// When the flow and the forces change by themselves.
  TimeCourse make_time_course() const;

  /// The forces in words, a line; springs, which every scene has, are passed over. Empty where there are no others.
  std::string describe_forces() const;

 private:
  std::vector<double> found_energies() const;
};

/// The physics of a scene, whose fibers are as written (see place_fibers).
/// @param team  ranks that share its sums, which must outlive it; null: none
/// @throws Error(scene_error) where the scene asks for what cannot be delivered
Physics make_physics(const SceneConfig& scene, SumTeam* team = nullptr);

}  // namespace skein
