#include <skein/core/error.hpp>
#include <skein/physics/spring_forces.hpp>

#include "tests/reference/force_balance.hpp"
#include "tests/reference/spring_reference.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace skein {
namespace {

using namespace reference;

double component(const Vec3& v, const int c) { return c == 0 ? v.x : c == 1 ? v.y : v.z; }
double& component(Vec3& v, const int c) { return c == 0 ? v.x : c == 1 ? v.y : v.z; }

std::vector<Vec3> forces_of(const SpringForces& springs, const std::vector<Vec3>& position) {
  const Vectors force("force", position.size());
  springs.add_forces(0.0, to_device("position", position), force);
  return to_host(force);
}

std::vector<double> energies_of(const SpringForces& springs, const std::vector<Vec3>& position,
                                const std::size_t n_fibers) {
  std::vector<double> energy(n_fibers);
  springs.add_energies(0.0, to_device("position", position), energy);
  return energy;
}

TEST(SpringForce, MatchesTheReferenceInRandomShapes) {
  for (const Shape& shape : shapes()) {
    const auto fibers = make_fibers(shape.configs);
    const auto position = deform(fibers, shape.deformation, 11);
    const auto force = forces_of(SpringForces(fibers), position);

    Elastic reference(position.size());
    for (const Fiber& fiber : fibers) add_springs(fiber.config, fiber.first_node, position, reference);
    Long largest = 0, error = 0;
    for (std::size_t i = 0; i < position.size(); ++i) {
      const LongVec f = reference.force[i];
      largest = std::max(largest, std::hypot(f.x, f.y, f.z));
      error = std::max(error, std::hypot(f.x - force[i].x, f.y - force[i].y, f.z - force[i].z));
    }
    // A last bit of r/l counts as much more of r/l - 1.
    EXPECT_LT(static_cast<double>(error / largest), 5e-15 + 1e-15 / shape.deformation)
        << shape.configs[0].sections << " sections of " << shape.configs[0].nodes_per_section << " nodes";
  }
}

TEST(SpringForce, EnergiesMatchTheReferenceFiberByFiber) {
  for (const Shape& shape : shapes()) {
    const auto fibers = make_fibers(shape.configs);
    const auto position = deform(fibers, shape.deformation, 12);
    const auto energy = energies_of(SpringForces(fibers), position, fibers.size());

    ASSERT_EQ(energy.size(), fibers.size());
    for (std::size_t i = 0; i < fibers.size(); ++i) {
      Elastic reference(position.size());
      add_springs(fibers[i].config, fibers[i].first_node, position, reference);
      EXPECT_NEAR(energy[i] / static_cast<double>(reference.energy), 1.0, 1e-13);
    }
  }
}

TEST(SpringForce, NoNetForceAndNoNetTorqueInAnyShape) {
  for (const Shape& shape : shapes()) {
    const auto fibers = make_fibers(shape.configs);
    const auto position = deform(fibers, shape.deformation, 13);
    const auto force = forces_of(SpringForces(fibers), position);
    for (const Fiber& fiber : fibers) {
      const auto sum = reference::sum_forces(position, force, fiber.first_node, fiber.n_nodes());
      EXPECT_LT(norm(sum.net), 1e-13 * sum.size);
      EXPECT_LT(norm(sum.torque), 1e-13 * sum.moment);
    }
  }
}

TEST(SpringForce, IsMinusTheGradientOfTheEnergy) {
  const auto fibers = make_fibers({make_config(5, 18, 0.3, 0.7), make_config(4, 4, 0.1, 1.9)});
  const SpringForces springs(fibers);
  const auto position = deform(fibers, 0.3, 14);
  const auto force = forces_of(springs, position);
  const auto energy = [&](const std::vector<Vec3>& at) {
    const auto both = energies_of(springs, at, 2);
    return both[0] + both[1];
  };
  constexpr double step = 1e-5;
  for (std::size_t node = 0; node < position.size(); node += 7) {
    for (int c = 0; c < 3; ++c) {
      auto ahead = position, behind = position;
      component(ahead[node], c) += step;
      component(behind[node], c) -= step;
      EXPECT_NEAR(component(force[node], c), (energy(behind) - energy(ahead)) / (2 * step), 1e-7) << node;
    }
  }
}

TEST(SpringForce, StraightFiberIsAtRest) {
  const auto fibers = make_fibers({make_config(40, 18, 0.005, 0.0112)});
  for (const Vec3 f : forces_of(SpringForces(fibers), make_surface_nodes(fibers))) EXPECT_LT(norm(f), 1e-14);
}

TEST(SpringForce, AStretchedFiberPullsItsEndsTogether) {
  const auto fibers = make_fibers({make_config(10, 6, 0.3, 0.7)});
  auto position = make_surface_nodes(fibers);
  const Vec3 along = fibers[0].config.direction / norm(fibers[0].config.direction);
  for (Vec3& x : position) x = x + 0.1 * dot(x, along) * along;
  const auto force = forces_of(SpringForces(fibers), position);
  EXPECT_GT(dot(force.front(), along), 0.01);
  EXPECT_LT(dot(force.back(), along), -0.01);
}

TEST(SpringForce, SpringsOfLengthZeroExertNoForceAndNoNaN) {
  const auto fibers = make_fibers({make_config(3, 7, 0.3, 0.7), make_config(3, 66, 0.3, 0.7)});
  const SpringForces springs(fibers);
  const std::vector<Vec3> one_point(count_nodes(fibers), Vec3{0.4, -1.0, 2.0});
  for (const Vec3 f : forces_of(springs, one_point)) EXPECT_EQ(norm(f), 0.0);

  const auto first = make_fibers({make_config(3, 7, 0.3, 0.7)});
  auto position = deform(first, 0.1, 15);
  position[9] = position[4];
  const auto force = forces_of(SpringForces(first), position);
  Elastic reference(position.size());
  add_springs(first[0].config, 0, position, reference);
  for (const int node : {4, 9}) {
    EXPECT_NEAR(force[node].x, static_cast<double>(reference.force[node].x), 1e-13);
    EXPECT_NEAR(force[node].z, static_cast<double>(reference.force[node].z), 1e-13);
  }
}

TEST(SpringForce, NaNIsNotHidden) {
  const auto fibers = make_fibers({make_config(9, 7, 0.3, 0.7)});
  auto position = make_surface_nodes(fibers);
  position[30].y = NAN;
  const auto force = forces_of(SpringForces(fibers), position);
  EXPECT_TRUE(std::isnan(force[30].y));
  EXPECT_TRUE(std::isnan(force[31].y));
  EXPECT_FALSE(std::isnan(force[0].y));
}

TEST(SpringForce, NetworksMayReachFartherAndSkewed) {
  // Between sections s and s + 2 one helical spring per node: (s, a) to (s + 2, a + 2), of rest length 0.9.
  for (const int n : {5, 66}) {
    const auto fibers = make_fibers({make_config(12, n, 0.3, 0.7)});
    SpringNetwork network = make_spring_network(fibers[0]);
    network.stencil.reach = 2;
    network.stencil.stiffness.assign(3 * n, 0.0);
    network.stencil.rest_length.resize(3 * n, 0.9);
    network.stencil.stiffness[network.stencil.entry(2, 2)] = 1.3;
    const auto position = deform(fibers, 0.2, 16);
    const auto force = forces_of(SpringForces(std::vector<SpringNetwork>{network}), position);

    EXPECT_EQ(count_springs(network), 10 * n);
    std::vector<Vec3> expected(12 * n);
    for (int i = 0; i < 10 * n; ++i) {
      const int j = i + 2 * n - i % n + (i + 2) % n;
      const Vec3 d = position[i] - position[j];
      const Vec3 pull = -1.3 * (norm(d) / 0.9 - 1.0) / norm(d) * d;
      expected[i] = expected[i] + pull;
      expected[j] = expected[j] - pull;
    }
    for (int i = 0; i < 12 * n; ++i) EXPECT_LT(norm(force[i] - expected[i]), 1e-14) << i;
  }
}

TEST(SpringForce, RefusesArraysOfAnotherLength) {
  const SpringForces springs(make_fibers({make_config(3, 7, 0.3, 0.7)}));
  EXPECT_THROW(springs.add_forces(0.0, Vectors("position", 20), Vectors("force", 20)), Error);
  EXPECT_THROW(springs.add_forces(0.0, Vectors("position", 21), Vectors("force", 20)), Error);
  std::vector<double> energy(1), of_two(2);
  EXPECT_THROW(springs.add_energies(0.0, Vectors("position", 20), energy), Error);
  EXPECT_THROW(springs.add_energies(0.0, Vectors("position", 21), of_two), Error);
}

}  // namespace
}  // namespace skein
