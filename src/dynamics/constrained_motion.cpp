#include <skein/arrays/combination.hpp>
#include <skein/core/error.hpp>
#include <skein/dynamics/constrained_motion.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace skein {
namespace {

constexpr int max_iterations = 200;
// Of the forces' root mean square. What the forces of a fiber miss has neither sum nor torque, and does little to
// others.
constexpr double least_share = 1e-8;
constexpr double share_of_mobility_error = 0.1;
constexpr double rounding = 1e-13;  // of velocities

/// I + N M, where M v is what forces v make of the fluid and N the forces that keep fibers rigid in it, each as if it
/// were alone: zero for fibers that are, so that I - (I + N M) is the identity but for what fibers do to each other.
class Interaction final : public LinearOperator {
 public:
  Interaction(const Physics& physics, const RigidPoses& poses, const ConstVectors& places, const Vectors& induced)
      : physics_(physics), poses_(poses), places_(places), induced_(induced) {}

  void multiply(const ConstVectors& v, const Vectors& result) override {
    Kokkos::deep_copy(ExecSpace(), induced_, 0.0);
    physics_.mobility->add_velocity({places_, v, physics_.blob}, places_, induced_);
    Kokkos::deep_copy(ExecSpace(), result, v);
    physics_.rigid_bodies.add_constraint_forces(poses_, induced_, result);
  }
  void precondition(const ConstVectors& v, const Vectors& result) override {
    if (result.data() != v.data()) Kokkos::deep_copy(ExecSpace(), result, v);
  }

 private:
  const Physics& physics_;
  const RigidPoses& poses_;
  ConstVectors places_;
  Vectors induced_;
};

}  // namespace

ConstrainedMotion::ConstrainedMotion(const Physics& physics)
    : physics_(physics), poses_(physics.rigid_bodies.make_poses()) {
  if (physics.rigid_bodies.is_empty()) return;
  const std::size_t n_nodes = physics.blob.extent(0);
  residual_ = Vectors("skein::ConstrainedMotion::residual", n_nodes);
  correction_ = Vectors("skein::ConstrainedMotion::correction", n_nodes);
  induced_ = Vectors("skein::ConstrainedMotion::induced", n_nodes);
  gmres_ = std::make_unique<Gmres>(static_cast<int>(n_nodes), max_iterations);
}

void ConstrainedMotion::compute_places(const ConstVectors& position, const Vectors& places) const {
  if (places.data() != position.data()) Kokkos::deep_copy(ExecSpace(), places, position);
  if (physics_.rigid_bodies.is_empty()) return;
  physics_.rigid_bodies.compute_poses(position, poses_);
  physics_.rigid_bodies.place(poses_, places);
}

void ConstrainedMotion::solve(const ConstVectors& places, const Vectors& force, const Vectors& velocity) {
  const RigidBodies& bodies = physics_.rigid_bodies;
  if (bodies.is_empty()) {
    physics_.mobility->add_velocity({places, force, physics_.blob, true}, places, velocity);
    return;
  }
  bodies.compute_poses(places, poses_);
  bodies.spread_loads(poses_, force);
  bodies.add_constraint_forces(poses_, velocity, force);
  physics_.mobility->add_velocity({places, force, physics_.blob}, places, velocity);

  const ExecSpace space;
  Kokkos::deep_copy(space, residual_, 0.0);
  bodies.add_constraint_forces(poses_, velocity, residual_);
  bodies.compute_share(force, correction_);
  const double left = root_mean_square<ExecSpace>(space, residual_);
  const double size = std::max(left, root_mean_square<ExecSpace>(space, correction_));
  const double share = std::max(least_share, share_of_mobility_error * physics_.mobility->expected_error());
  // Below this, forces are what rounding makes of velocities, with a sum and a torque that nothing takes away.
  const double least = rounding * bodies.stiffest_drag() * root_mean_square<ExecSpace>(space, velocity);
  const double tolerance = std::max(share * size, least);
  // What is not finite is in the velocities by now, where it is looked for.
  if (std::isfinite(tolerance) && left > tolerance) add_interaction(places, tolerance, force, velocity);
  bodies.make_rigid(poses_, velocity);
}

void ConstrainedMotion::compute_forces(const double time, const ConstVectors& places, const Vectors& force) {
  physics_.compute_forces(time, places, force);
  if (physics_.rigid_bodies.is_empty()) return;
  const Vectors velocity("skein::ConstrainedMotion::velocity", places.extent(0));
  physics_.flow->add_velocity(time, places, velocity);
  solve(places, force, velocity);
}

void ConstrainedMotion::add_interaction(const ConstVectors& places, const double tolerance, const Vectors& force,
                                        const Vectors& velocity) {
  const ExecSpace space;
  Interaction interaction(physics_, poses_, places, induced_);
  Kokkos::deep_copy(space, correction_, 0.0);
  const Gmres::Result solved = gmres_->solve(interaction, 1.0, residual_, correction_, tolerance);
  if (!solved.converged && std::isfinite(solved.residual))
    throw Error(ExitCode::numerical,
                fmt::format("the forces that keep fibers rigid were not found: after {} iterations they miss by {:.3g} "
                            "times what is allowed. Fibers may lie in each other: see the series' smallest_gap",
                            solved.iterations, solved.residual / tolerance));
  combine<ExecSpace>(space, force, {1.0, force}, {1.0, correction_});
  physics_.mobility->add_velocity({places, correction_, physics_.blob}, places, velocity);
}

}  // namespace skein
