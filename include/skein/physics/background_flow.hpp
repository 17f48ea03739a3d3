#pragma once

#include <skein/arrays/types.hpp>
#include <skein/core/time_course.hpp>
#include <skein/physics/velocity_gradient.hpp>
#include <skein/scene/scene_config.hpp>

#include <memory>
#include <string>
#include <vector>

namespace skein {

/// The flow far from all fibers.
class BackgroundFlow {
 public:
  virtual ~BackgroundFlow() = default;

  /// velocity += the flow at each position.
  /// @param position, velocity  [n, 3], length and length / time. Returns before a device has finished.
  /// @throws Error(internal) if the extents differ
  virtual void add_velocity(double time, const ConstVectors& position, const Vectors& velocity) const = 0;

  /// velocity = the flow at each position, in as few launches.
  virtual void compute_velocity(const double time, const ConstVectors& position, const Vectors& velocity) const {
    Kokkos::deep_copy(ExecSpace(), velocity, 0.0);
    add_velocity(time, position, velocity);
  }

  /// At one position, exactly.
  virtual VelocityGradient gradient(double time, Vec3 position) const = 0;

  /// Largest rate of deformation sqrt(2 E : E), E the symmetric part of the velocity gradient: the shear rate of a
  /// shear flow, twice the stretching rate of a planar extension, 0 where the fluid turns as a rigid body. A sum of
  /// flows counts as if all were largest at one place and time. 1 / time
  virtual double typical_rate() const = 0;

  /// Time in which the flow changes what it carries, where it is at its strongest; infinite for a fluid at rest.
  virtual double time_scale() const = 0;

  /// Adds when it changes by itself; nothing of a steady flow.
  virtual void add_course(TimeCourse& /*course*/) const {}

  /// One line for the first lines of a run.
  virtual std::string describe() const = 0;
};

/// The sum of a scene's flows. A new kind is an enumerator in include/skein/scene/choices.hpp, its word in
/// src/scene/words.cpp and its row in src/physics/flow_table.cpp; where none of the shapes in kernels/flow_velocity.hpp
/// fits, also a formula and its gradient in kernels/flow_velocity.cpp.
/// @throws Error(internal) for a kind without a row
std::unique_ptr<BackgroundFlow> make_background_flow(const std::vector<FlowConfig>& flows);

}  // namespace skein
