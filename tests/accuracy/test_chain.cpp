// A chain in a tube's stead: what it takes over, and that it moves like the tube.
#include <skein/core/error.hpp>
#include <skein/fibers/calibration.hpp>
#include <skein/physics/chain.hpp>
#include <skein/physics/physics.hpp>
#include <skein/physics/rigid_tube.hpp>
#include <skein/scene/fiber_spacing.hpp>

#include "tests/accuracy/dense_operators.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

namespace skein {
namespace {

/// The paper's tube, of so many sections.
FiberConfig make_chain_of_tube(const int sections) {
  FiberConfig fiber;
  fiber.model = FiberModel::chain;
  fiber.sections = sections;
  return fiber;
}

FiberConfig resolve(const FiberConfig& fiber, const double viscosity = 1.0) {
  SceneConfig scene;
  scene.fluid.viscosity = viscosity;
  scene.fibers = {fiber};
  return resolve_chains(scene).fibers.front();
}

Fiber make_tube(FiberConfig fiber) {
  fiber.model = FiberModel::tube;
  return make_fibers({fiber}).front();
}

TEST(Chain, KeepsTheTubesLengthAndStiffness) {
  for (const int sections : {80, 113, 301}) {
    const FiberConfig config = make_chain_of_tube(sections);
    const Fiber tube = make_tube(config), chain = make_fibers({resolve(config)}).front();
    EXPECT_NEAR(chain.length(), tube.length(), 1e-15);
    EXPECT_NEAR(chain.spacing(), 0.01, 2e-4);
    EXPECT_EQ(chain.n_nodes(), chain.config.sections);
    const BeamStiffness found = measure_beam_stiffness(chain), known = measure_beam_stiffness(tube);
    EXPECT_DOUBLE_EQ(found.bending, known.relaxed_bending);
    EXPECT_DOUBLE_EQ(found.axial, known.relaxed_axial);
  }
}

TEST(Chain, DragsAndIsHeldInAShearLikeTheTube) {
  for (const int sections : {40, 80, 301}) {
    const FiberConfig config = make_chain_of_tube(sections);
    const RigidTubeDrag drag = measure_rigid_tube(make_tube(config), 1.0);
    const ChainMatch match = match_chain(config, 1.0);
    EXPECT_NEAR(match.transverse, 1.0, 0.04) << sections;
    EXPECT_NEAR(match.axial, 1.0, 0.06) << sections;

    // Solved without the chain's own formulas.
    const FiberConfig chain = resolve(config);
    dense::Points points;
    for (int i = 0; i < chain.sections; ++i)
      points.push_back({(i - 0.5 * (chain.sections - 1)) * chain.spacing, 0.0, 0.0});
    const Eigen::LLT<Eigen::MatrixXd> mobility(dense::make_mobility(points, chain.blob, 1.0));
    Eigen::VectorXd turn = Eigen::VectorXd::Zero(3 * chain.sections);
    for (int i = 0; i < chain.sections; ++i) turn[3 * i + 1] = points[i].x();
    EXPECT_NEAR(turn.dot(mobility.solve(turn)) / drag.turning, 1.0, 1e-9) << sections;
  }
}

/// The torque of a scene's forces on its straight fiber, about the origin.
Vec3 measure_torque(const SceneConfig& scene) {
  const Physics physics = make_physics(scene);
  const std::vector<Vec3> nodes = make_surface_nodes(physics.fibers);
  const Vectors force("force", nodes.size());
  physics.compute_forces(0.0, to_device("position", nodes), force);
  const std::vector<Vec3> forces = to_host(ConstVectors(force));
  Vec3 torque;
  for (std::size_t i = 0; i < nodes.size(); ++i) torque = torque + cross(nodes[i], forces[i]);
  return torque;
}

// Along a shear a line itself is not turned; across one it is turned by its whole drag, the tube by less.
TEST(Chain, IsTurnedInAShearWithTheTubesTorque) {
  SceneConfig scene;
  scene.fluid.viscosity = 1.7;
  scene.fibers = {make_chain_of_tube(80)};
  scene.flows.front().rate = 2.0;
  const RigidTubeDrag drag = measure_rigid_tube(make_tube(scene.fibers.front()), 1.7);
  EXPECT_NEAR(measure_torque(scene).z, -2.0 * drag.torque_along, 1e-9 * drag.torque_along);
  scene.fibers.front().direction = {0.0, 1.0, 0.0};
  EXPECT_NEAR(measure_torque(scene).z, 2.0 * (drag.turning - drag.torque_across), 1e-8 * drag.torque_along);
}

TEST(Chain, IsTakenAlongByARotatingFluidWithoutATorque) {
  SceneConfig scene;
  scene.fibers = {make_chain_of_tube(80)};
  scene.fibers.front().direction = {0.3, 0.9, 0.2};
  scene.flows = {{.kind = FlowKind::rotation, .rate = 2.0}};
  const RigidTubeDrag drag = measure_rigid_tube(make_tube(scene.fibers.front()), 1.0);
  EXPECT_LT(norm(measure_torque(scene)), 1e-12 * drag.torque_along);
}

// E = EI kappa^2 / 2 on the length that can bend, softer by (kappa spacing)^2 / 12 of itself.
TEST(Chain, StoresTheEnergyOfABentBeam) {
  SceneConfig scene;
  scene.fibers = {make_chain_of_tube(301)};
  const Physics physics = make_physics(scene);
  const Fiber& fiber = physics.fibers.front();
  for (const double curvature : {2.0, 50.0}) {
    const double radius = 0.5 * fiber.spacing() / std::sin(0.5 * curvature * fiber.spacing());
    std::vector<Vec3> arc;
    for (int i = 0; i < fiber.n_nodes(); ++i) {
      const double angle = curvature * fiber.spacing() * i;
      arc.push_back({radius * std::sin(angle), -radius * std::cos(angle), 0.0});
    }
    const double energy = physics.compute_energies(0.0, to_device("arc", arc)).front();
    const double bent_length = (fiber.n_nodes() - 2) * fiber.spacing(), turn = curvature * fiber.spacing();
    const double known = 0.5 * fiber.config.bending_rigidity * curvature * curvature * bent_length;
    EXPECT_NEAR(energy / known, 1.0 - turn * turn / 12.0, 2e-3 * turn * turn + 1e-9);
  }
}

TEST(Chain, GoesWithUnitsAndViscosity) {
  FiberConfig config = make_chain_of_tube(80), larger = config;
  larger.radius *= 4.0;
  larger.blob *= 4.0;
  const FiberConfig one = resolve(config), other = resolve(larger, 2.0);
  EXPECT_EQ(other.sections, one.sections);
  EXPECT_EQ(other.blob, 4.0 * one.blob);
  EXPECT_EQ(other.shear_couple, 2.0 * 16.0 * one.shear_couple);
  EXPECT_EQ(other.end_couple, 2.0 * 64.0 * one.end_couple);
}

TEST(Chain, OfALongTubeIsThatOfAPieceOfIt) {
  const FiberConfig one = resolve(make_chain_of_tube(301)), other = resolve(make_chain_of_tube(1313));
  EXPECT_NEAR(other.blob / one.blob, 1.0, 5e-3);
  EXPECT_NEAR(other.shear_couple / one.shear_couple, 1.0, 1e-2);
  EXPECT_NEAR(make_fibers({other}).front().length(), make_tube(make_chain_of_tube(1313)).length(), 1e-14);
}

TEST(Chain, IsResolvedOnceAndPlacesStay) {
  SceneConfig scene;
  for (const double height : {0.0, 0.1, 0.2}) {
    scene.fibers.push_back(make_chain_of_tube(40));
    scene.fibers.back().center.z = height;
    scene.fibers.back().start_amplitude = height;
  }
  scene.fibers[1].model = FiberModel::tube;
  const SceneConfig resolved = resolve_chains(scene);
  EXPECT_EQ(resolved.fibers[1], scene.fibers[1]);
  EXPECT_EQ(resolved.fibers[2].center, scene.fibers[2].center);
  EXPECT_EQ(resolved.fibers[2].start_amplitude, 0.2);
  EXPECT_EQ(resolved.fibers[2].blob, resolved.fibers[0].blob);
  EXPECT_EQ(resolve_chains(resolved), resolved);
}

TEST(Chain, HasAsManyNodesAsAskedFor) {
  FiberConfig config = make_chain_of_tube(80);
  config.chain_nodes = 30;
  const FiberConfig chain = resolve(config);
  EXPECT_EQ(chain.sections, 30);
  EXPECT_NEAR(chain.sections * chain.spacing, make_tube(config).length(), 1e-15);
  // Its end nodes stand farther out, so that thinner ones are as hard to turn.
  EXPECT_NEAR(chain.blob / resolve(make_chain_of_tube(80)).blob, 0.85, 0.05);
}

TEST(Chain, IsRefusedInTheSteadOfADisc) {
  FiberConfig config = make_chain_of_tube(4);
  config.radius = 0.05;
  config.spacing = 0.001;
  config.blob = 0.002;
  EXPECT_THROW(resolve(config), Error);
}

}  // namespace
}  // namespace skein
