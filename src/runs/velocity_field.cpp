#include "runs/velocity_field.hpp"

#include <skein/core/error.hpp>
#include <skein/physics/direct_mobility.hpp>
#include <skein/physics/physics.hpp>

namespace skein {

VelocityField compute_velocity_field(const SceneConfig& scene, const double time, const std::vector<Vec3>& nodes,
                                     const std::vector<Vec3>& points) {
  const Physics physics = make_physics(scene);
  SKEIN_REQUIRE(static_cast<int>(nodes.size()) == count_nodes(physics.fibers), "nodes are those of the scene's fibers");
  const Vectors position = to_device("skein::velocity_field::position", nodes);
  const Vectors target = to_device("skein::velocity_field::target", points);
  const Vectors force("skein::velocity_field::force", nodes.size());
  physics.compute_forces(time, position, force);

  VelocityField field;
  const Vectors velocity("skein::velocity_field::velocity", points.size());
  DirectMobility(scene.fluid.viscosity, Precision::in_double)
      .add_velocity({position, force, physics.blob}, target, velocity);
  field.disturbance = to_host(velocity);
  physics.flow->add_velocity(time, target, velocity);
  field.total = to_host(velocity);
  return field;
}

}  // namespace skein
