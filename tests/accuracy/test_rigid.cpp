// Rigid fibers: one alone against Jeffery's and Stokes' answers, several against one dense solution of all.
#include <skein/core/error.hpp>
#include <skein/dynamics/fiber_dynamics.hpp>
#include <skein/dynamics/make_integrator.hpp>
#include <skein/physics/chain.hpp>
#include <skein/physics/direct_mobility.hpp>
#include <skein/physics/rigid_tube.hpp>

#include "runs/force_probe.hpp"
#include "runs/observables.hpp"
#include "tests/accuracy/dense_rigid_motion.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace skein {
namespace {

constexpr double pi = std::numbers::pi;

FiberConfig make_rigid(const int sections, const Vec3 direction = {1.0, 0.0, 0.0}, const Vec3 center = {}) {
  FiberConfig fiber;
  fiber.model = FiberModel::rigid;
  fiber.sections = sections;
  fiber.direction = direction;
  fiber.center = center;
  return fiber;
}

Fiber make_tube(FiberConfig fiber) {
  fiber.model = FiberModel::tube;
  return make_fibers({fiber}).front();
}

SceneConfig make_scene(const std::vector<FiberConfig>& fibers, const FlowConfig& flow = {}) {
  SceneConfig scene;
  scene.fluid.viscosity = 1.3;
  scene.flows = {flow};
  scene.fibers = fibers;
  return scene;
}

/// A scene's fibers at their start, and what moves them.
struct Moment {
  explicit Moment(const SceneConfig& scene)
      : physics(make_physics(scene)), dynamics(physics), position(make_surface_nodes(physics.fibers, scene.seed)) {}

  std::vector<Vec3> compute_velocity() {
    const Vectors velocity("velocity", position.size());
    dynamics.compute_velocity(0.0, to_device("position", position), velocity);
    return to_host(ConstVectors(velocity));
  }
  std::vector<Vec3> compute_forces() const {
    const Vectors force("force", position.size());
    physics.compute_forces(0.0, to_device("position", position), force);
    return to_host(ConstVectors(force));
  }

  Physics physics;
  FiberDynamics dynamics;
  std::vector<Vec3> position;
};

/// Where the nodes are at the scene's end.
std::vector<Vec3> run_to_end(const SceneConfig& scene) {
  Moment moment(scene);
  const auto integrator = make_integrator(scene, moment.physics, moment.dynamics);
  State state{0.0, 0, to_device("position", moment.position)};
  while (state.time < scene.time.end) integrator->advance(state, scene.time.end);
  return to_host(ConstVectors(state.position));
}

double largest_difference(const std::vector<Vec3>& a, const std::vector<Vec3>& b) {
  double largest = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) largest = std::max(largest, norm(a[i] - b[i]));
  return largest;
}

double largest_of(const std::vector<Vec3>& a) { return largest_difference(a, std::vector<Vec3>(a.size())); }

Eigen::Vector3d shear(const Eigen::Vector3d& x) { return {2.5 * x.y(), 0.0, 0.0}; }

// Jeffery's equation with the tube's own aspect ratio, whatever the direction.
TEST(Rigid, TurnsInAShearLikeJefferysEllipsoid) {
  for (const int sections : {40, 80, 301})
    for (const Vec3 direction : {Vec3{1.0, 0.0, 0.0}, {0.0, 1.0, 0.0}, {0.4, -0.8, 0.3}, {-0.9, 0.1, 0.4}}) {
      const double ratio = measure_rigid_tube(make_tube(make_rigid(sections)), 1.0).effective_aspect_ratio();
      Moment moment(make_scene({make_rigid(sections, direction)}));
      const std::vector<Vec3> velocity = moment.compute_velocity();
      const Vec3 arm = moment.position.back() - moment.position.front(), p = arm / norm(arm);
      const Vec3 found = (velocity.back() - velocity.front()) / norm(arm);
      const double shape = (ratio * ratio - 1.0) / (ratio * ratio + 1.0), half_rate = 0.5 * 2.5;
      const Vec3 strained = half_rate * Vec3{p.y, p.x, 0.0}, spun = half_rate * Vec3{p.y, -p.x, 0.0};
      const Vec3 known = spun + shape * (strained - dot(p, strained) * p);
      EXPECT_LT(norm(found - known), 2e-9 * 2.5) << sections;
      EXPECT_LT(norm(velocity.back() + velocity.front()), 1e-12) << sections;
    }
}

TEST(Rigid, HasJefferysPeriod) {
  for (const int sections : {80, 301})
    for (const TimeMethod method : {TimeMethod::rkc2, TimeMethod::bs3}) {
      SceneConfig scene = make_scene({make_rigid(sections)});
      const double ratio = measure_rigid_tube(make_tube(make_rigid(sections)), 1.0).effective_aspect_ratio();
      const double half_period = pi / 2.5 * (ratio + 1.0 / ratio);
      scene.time.method = method;
      scene.time.end = half_period;
      Moment moment(scene);
      const auto integrator = make_integrator(scene, moment.physics, moment.dynamics);
      State state{0.0, 0, to_device("position", moment.position)};
      while (state.time < scene.time.end) integrator->advance(state, scene.time.end);
      // Turned by half a turn; a time that is off by 1 % shows as that share of the slow turn along the flow.
      const std::vector<Vec3> x = to_host(ConstVectors(state.position));
      const Vec3 arm = x.front() - x.back();
      const double slowest = 2.5 / (ratio * ratio + 1.0), angle = std::atan2(arm.y, arm.x);
      EXPECT_LT(std::abs(angle), slowest * 0.01 * half_period) << sections;
      EXPECT_GT(arm.x, 0.0) << sections;
    }
}

TEST(Rigid, IsTakenAlongByARotatingFluid) {
  Moment moment(
      make_scene({make_rigid(80, {0.3, 0.9, 0.2}, {0.1, 0.0, 0.05})}, {.kind = FlowKind::rotation, .rate = 1.7}));
  const std::vector<Vec3> velocity = moment.compute_velocity();
  for (std::size_t i = 0; i < velocity.size(); ++i) {
    const Vec3 x = moment.position[i], known{-1.7 * x.y, 1.7 * x.x, 0.0};
    EXPECT_LT(norm(velocity[i] - known), 1e-12);
  }
}

// Elastic ones of a hundred and of four hundred times the paper's stiffness bend by that much less.
TEST(Rigid, IsTheLimitOfStiffChains) {
  const auto turn = [](const FiberModel model, const double stiffness) {
    SceneConfig scene = make_scene({make_rigid(80, {1.0, 0.4, 0.3})});
    scene.fibers[0].model = model;
    scene.fibers[0].spring_stiffness *= stiffness;
    scene.time.end = 2.0;
    scene.time.tolerance = 1e-6;
    return run_to_end(scene);
  };
  const std::vector<Vec3> rigid = turn(FiberModel::rigid, 1.0);
  const double length = make_tube(make_rigid(80)).length();
  const double stiff = largest_difference(turn(FiberModel::chain, 100.0), rigid),
               stiffer = largest_difference(turn(FiberModel::chain, 400.0), rigid);
  EXPECT_LT(stiff, 2e-3 * length);
  EXPECT_NEAR(stiffer / stiff, 0.25, 0.05);
}

TEST(Rigid, FallsLikeTheTubeAndDrifts) {
  for (const int sections : {80, 301}) {
    const RigidTubeDrag tube = measure_rigid_tube(make_tube(make_rigid(sections)), 1.3);
    const auto fall = [&](const Vec3 direction) {
      SceneConfig scene = make_scene({make_rigid(sections, direction)}, {.kind = FlowKind::none});
      scene.gravity = {0.7, {0.0, -1.0, 0.0}};
      Moment moment(scene);
      const std::vector<Vec3> velocity = moment.compute_velocity();
      EXPECT_LT(norm(velocity.back() - velocity.front()), 1e-10 * norm(velocity.front()));
      return velocity.front();
    };
    const double weight = 0.7 * make_tube(make_rigid(sections)).length();
    const double across = weight / -fall({1.0, 0.0, 0.0}).y, along = weight / -fall({0.0, 1.0, 0.0}).y;
    EXPECT_NEAR(across / tube.transverse, 1.0, 0.04) << sections;
    EXPECT_NEAR(along / tube.axial, 1.0, 0.06) << sections;
    // Tilted by an angle, it moves at tan(drift) = (1/along - 1/across) sin cos / (sin^2/along + cos^2/across).
    const double tilt = 0.6, s = std::sin(tilt), c = std::cos(tilt);
    const Vec3 velocity = fall({c, s, 0.0});
    const double slope = (1.0 / along - 1.0 / across) * s * c / (s * s / along + c * c / across);
    EXPECT_NEAR(velocity.x / velocity.y, slope, 1e-9) << sections;
  }
}

/// Three near each other, one much shorter, pulled about; the third one may be elastic.
SceneConfig make_crowd(const FiberModel third) {
  SceneConfig scene = make_scene({make_rigid(60, {1.0, 0.2, 0.0}), make_rigid(35, {0.1, 1.0, 0.3}, {0.01, 0.0, 0.016}),
                                  make_rigid(50, {0.5, -0.2, 1.0}, {-0.02, 0.05, 0.01})});
  scene.fibers[1].radius = 0.003;
  scene.fibers[1].blob = 0.0014;
  scene.fibers[2].model = third;
  if (third == FiberModel::chain) scene.fibers[2].start_amplitude = 0.05;
  scene.gravity = {1.9, {0.3, -0.5, 0.2}};
  scene.tethers = {{0, 2, 1.3, {0.01, 0.02, -0.03}}, {1, -1, 0.7, {0.0, -0.01, 0.02}}};
  return scene;
}

TEST(Rigid, FibersMoveAsOneDenseSolutionOfAllSays) {
  for (const FiberModel third : {FiberModel::rigid, FiberModel::chain}) {
    Moment moment(make_crowd(third));
    const dense::RigidMotion dense(moment.physics.fibers, moment.position, moment.compute_forces(), 1.3, shear);
    const std::vector<Vec3> velocity = moment.compute_velocity();
    EXPECT_LT(largest_difference(velocity, dense.velocity), 1e-9 * largest_of(dense.velocity));
    // Alone, they would move otherwise.
    SceneConfig alone = make_crowd(third);
    alone.fibers.resize(1);
    alone.tethers.resize(1);
    const std::vector<Vec3> other = Moment(alone).compute_velocity();
    EXPECT_GT(norm(other.front() - velocity.front()), 1e-2 * norm(velocity.front()));
  }
}

TEST(Rigid, SinglePrecisionPairsAreGoodForSixDigits) {
  SceneConfig scene = make_crowd(FiberModel::rigid);
  const std::vector<Vec3> exact = Moment(scene).compute_velocity();
  scene.hydrodynamics.method = SumMethod::direct;
  scene.hydrodynamics.precision = Precision::in_single;
  EXPECT_LT(largest_difference(Moment(scene).compute_velocity(), exact), 3e-6 * largest_of(exact));
}

TEST(Rigid, ForcesOnTheFluidHaveTheSumAndTheTorqueOfTheScenes) {
  Moment moment(make_crowd(FiberModel::chain));
  const std::vector<Vec3> given = moment.compute_forces();
  const Vectors force = to_device("force", given), velocity("velocity", given.size());
  const Vectors position = to_device("position", moment.position);
  moment.physics.flow->add_velocity(0.0, position, velocity);
  ConstrainedMotion(moment.physics).solve(position, force, velocity);
  const std::vector<Vec3> found = to_host(ConstVectors(force));
  const dense::RigidMotion dense(moment.physics.fibers, moment.position, moment.compute_forces(), 1.3, shear);
  EXPECT_LT(largest_difference(found, dense.force), 1e-8 * largest_of(dense.force));
  for (const Fiber& fiber : moment.physics.fibers) {
    Vec3 sum, torque;
    double size = 0.0;
    for (int i = fiber.first_node; i < fiber.first_node + fiber.n_nodes(); ++i) {
      const Vec3 more = found[i] - given[i];
      sum = sum + more;
      torque = torque + cross(moment.position[i] - fiber.config.center, more);
      size += norm(more);
    }
    EXPECT_LT(norm(sum), 1e-12 * size + 1e-300);
    // About its own axis, which turns nothing, and where nodes stand on it to rounding only, there is none to speak of.
    EXPECT_LT(norm(torque), 1e-11 * size * fiber.length() + 1e-300);
  }
}

// By the forces of the dense solution: the elastic chain's stress is of springs, a rigid fiber's of what keeps it
// rigid.
TEST(Rigid, StressIsTheFirstMomentOfItsForces) {
  SceneConfig scene = make_crowd(FiberModel::rigid);
  scene.gravity.weight = 0.0;
  scene.tethers.clear();
  Moment moment(scene);
  const dense::RigidMotion dense(moment.physics.fibers, moment.position, moment.compute_forces(), 1.3, shear);
  const auto records =
      probe_forces(moment.physics, make_frame(moment.physics, 0, 0.0, to_device("x", moment.position)));
  for (const Fiber& fiber : moment.physics.fibers) {
    Eigen::Matrix3d first_moment = Eigen::Matrix3d::Zero();
    for (int i = fiber.first_node; i < fiber.first_node + fiber.n_nodes(); ++i)
      first_moment -=
          dense::to_eigen(moment.position[i] - fiber.config.center) * dense::to_eigen(dense.force[i]).transpose();
    Eigen::Matrix3d known = 0.5 * (first_moment + first_moment.transpose());
    known -= known.trace() / 3.0 * Eigen::Matrix3d::Identity();
    Eigen::Matrix3d found;
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) found(i, j) = records[fiber.index].stresslet[i][j];
    EXPECT_LT((found - known).norm(), 1e-8 * known.norm());
    EXPECT_GT(records[fiber.index].viscosity_contribution, 0.0);
    EXPECT_EQ(records[fiber.index].energy, 0.0);
    EXPECT_NEAR(records[fiber.index].power.elastic(), 0.0, 1e-8 * records[fiber.index].power.dissipation);
  }
}

TEST(Rigid, StaysStraightAndKeepsItsLength) {
  for (const TimeMethod method :
       {TimeMethod::rkc2, TimeMethod::rk4, TimeMethod::bs3, TimeMethod::automatic, TimeMethod::euler}) {
    SceneConfig scene =
        make_scene({make_rigid(60, {0.5, 1.0, 0.2}), make_rigid(40, {1.0, 0.4, 0.0}, {0.0, 0.02, 0.02})});
    scene.time.method = method;
    scene.time.end = 2.0;
    if (method == TimeMethod::euler) scene.time.step = 0.02;
    Moment moment(scene);
    const auto integrator = make_integrator(scene, moment.physics, moment.dynamics);
    State state{0.0, 0, to_device("position", moment.position)};
    const Vectors between("between", moment.position.size());
    while (state.time < scene.time.end) {
      const double before = state.time;
      integrator->advance(state, scene.time.end);
      integrator->interpolate(before + 0.3 * (state.time - before), between);
      for (const Vectors& nodes : {state.position, between}) {
        const std::vector<Vec3> x = to_host(ConstVectors(nodes));
        for (const Fiber& fiber : moment.physics.fibers) {
          const Vec3 first = x[fiber.first_node], arm = x[fiber.first_node + fiber.n_nodes() - 1] - first;
          for (int i = 0; i < fiber.n_nodes(); ++i) {
            const Vec3 known = first + (static_cast<double>(i) / (fiber.n_nodes() - 1)) * arm;
            ASSERT_LT(norm(x[fiber.first_node + i] - known), 1e-15);
          }
          ASSERT_NEAR(norm(arm), fiber.length() - fiber.spacing(), 1e-15);
        }
      }
    }
  }
}

// Steps that are put back onto rigid bodies keep the method's order.
TEST(Rigid, StepsKeepTheirOrder) {
  const auto end_with = [](const TimeMethod method, const double step) {
    SceneConfig scene =
        make_scene({make_rigid(60, {0.5, 1.0, 0.2}), make_rigid(40, {1.0, 0.4, 0.0}, {0.0, 0.02, 0.02})});
    scene.time.method = method;
    scene.time.step = step;
    scene.time.end = 0.8;
    return run_to_end(scene);
  };
  const std::vector<Vec3> exact = end_with(TimeMethod::rk4, 0.0025);
  const std::pair<TimeMethod, double> orders[] = {
      {TimeMethod::rkc2, 2.0}, {TimeMethod::bs3, 3.0}, {TimeMethod::rk4, 4.0}};
  for (const auto& [method, order] : orders) {
    const double coarse = largest_difference(end_with(method, 0.04), exact);
    const double fine = largest_difference(end_with(method, 0.02), exact);
    EXPECT_NEAR(std::log2(coarse / fine), order, 0.35) << static_cast<int>(method);
  }
}

TEST(Rigid, IsLaidOutAsTheChainIs) {
  FiberConfig chain = make_rigid(113);
  chain.model = FiberModel::chain;
  const SceneConfig resolved = resolve_chains(make_scene({make_rigid(113), chain}));
  FiberConfig same = resolved.fibers[0];
  EXPECT_TRUE(same.is_rigid());
  same.model = FiberModel::chain;
  EXPECT_EQ(same, resolved.fibers[1]);
  EXPECT_EQ(resolve_chains(resolved), resolved);
}

TEST(Rigid, IsRefusedWithABlobThatHidesItsNodes) {
  FiberConfig fiber = resolve_chains(make_scene({make_rigid(80)})).fibers.front();
  fiber.blob = 20.0 * fiber.spacing;
  EXPECT_THROW(make_physics(make_scene({fiber})), Error);
}

}  // namespace
}  // namespace skein
