#include "runs/velocity_field.hpp"

#include <skein/core/error.hpp>
#include <skein/dynamics/constrained_motion.hpp>
#include <skein/physics/direct_mobility.hpp>
#include <skein/physics/physics.hpp>

#include <fmt/format.h>

#include <cmath>
#include <memory>

namespace skein {
namespace {

void check_finite(const std::vector<Vec3>& velocity, const std::vector<Vec3>& points) {
  for (std::size_t i = 0; i < velocity.size(); ++i) {
    const Vec3 u = velocity[i], x = points[i];
    if (std::isfinite(u.x) && std::isfinite(u.y) && std::isfinite(u.z)) continue;
    throw Error(ExitCode::numerical,
                fmt::format("the velocity at ({:g}, {:g}, {:g}) is ({:g}, {:g}, {:g}): the point is "
                            "too far away for the flow",
                            x.x, x.y, x.z, u.x, u.y, u.z));
  }
}

}  // namespace

VelocityField compute_velocity_field(const SceneConfig& scene, const double time, const std::vector<Vec3>& nodes,
                                     const std::vector<Vec3>& points, const FieldSum sum) {
  Physics physics = make_physics(scene);
  if (sum == FieldSum::direct_in_double)
    physics.mobility = std::make_unique<DirectMobility>(scene.fluid.viscosity, Precision::in_double);
  SKEIN_REQUIRE(static_cast<int>(nodes.size()) == count_nodes(physics.fibers), "nodes are those of the scene's fibers");
  const Vectors position = to_device("skein::velocity_field::position", nodes);
  const Vectors target = to_device("skein::velocity_field::target", points);
  const Vectors force("skein::velocity_field::force", nodes.size());
  ConstrainedMotion motion(physics);
  motion.compute_places(position, position);
  motion.compute_forces(time, position, force);

  VelocityField field;
  const Vectors velocity("skein::velocity_field::velocity", points.size());
  physics.mobility->add_velocity({position, force, physics.blob}, target, velocity);
  field.disturbance = to_host(velocity);
  physics.flow->add_velocity(time, target, velocity);
  field.total = to_host(velocity);
  field.method = physics.mobility->describe();
  field.messages = physics.mobility->take_messages();
  check_finite(field.total, points);
  return field;
}

}  // namespace skein
