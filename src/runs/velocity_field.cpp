#include "runs/velocity_field.hpp"

#include <skein/core/error.hpp>
#include <skein/physics/background_flow.hpp>
#include <skein/physics/direct_mobility.hpp>
#include <skein/physics/section_repulsion.hpp>
#include <skein/physics/spring_forces.hpp>

namespace skein {

VelocityField compute_velocity_field(const SceneConfig& scene, const double time, const std::vector<Vec3>& nodes,
                                     const std::vector<Vec3>& points) {
  const auto fibers = make_fibers(scene.fibers);
  SKEIN_REQUIRE(static_cast<int>(nodes.size()) == count_nodes(fibers), "nodes are those of the scene's fibers");
  const Vectors position = to_device("skein::velocity_field::position", nodes);
  const Vectors target = to_device("skein::velocity_field::target", points);
  const Scalars blob = to_device("skein::velocity_field::blob", make_blobs(fibers));
  const Vectors force("skein::velocity_field::force", nodes.size());
  SpringForces(fibers).compute_forces(position, force);
  if (const auto repulsion = make_section_repulsion(scene.repulsion, fibers)) repulsion->add_forces(position, force);

  VelocityField field;
  const Vectors velocity("skein::velocity_field::velocity", points.size());
  DirectMobility(scene.fluid.viscosity, Precision::in_double).add_velocity({position, force, blob}, target, velocity);
  field.disturbance = to_host(velocity);
  make_background_flow(scene.flows)->add_velocity(time, target, velocity);
  field.total = to_host(velocity);
  return field;
}

}  // namespace skein
