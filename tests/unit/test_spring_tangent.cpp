// The change of the springs' forces, in tiles of sections and node by node.
#include <skein/core/error.hpp>
#include <skein/physics/spring_forces.hpp>

#include "tests/reference/point_cloud.hpp"
#include "tests/reference/regularized_stokeslet_reference.hpp"
#include "tests/reference/spring_reference.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>

namespace skein {
namespace {

using namespace reference;

using Nodes = std::vector<Vec3>;

Nodes make_displacement(const std::size_t n_nodes) {
  reference::Random random(5);
  return reference::make_random_vectors(static_cast<int>(n_nodes), 1.0, random);
}

/// Added to nothing.
Nodes change_by(const SpringForces& springs, const Nodes& position, const Nodes& displacement) {
  const Vectors change("change", position.size());
  springs.add_force_changes(0.0, to_device("x", position), to_device("u", displacement), change);
  return to_host(ConstVectors(change));
}

TEST(SpringTangent, MatchesTheReferenceInRandomShapes) {
  for (const Shape& shape : shapes()) {
    const auto fibers = make_fibers(shape.configs);
    const Nodes position = deform(fibers, shape.deformation, 11), displacement = make_displacement(position.size());
    const Nodes change = change_by(SpringForces(fibers), position, displacement);

    Elastic expected(position.size());
    for (const Fiber& fiber : fibers) add_springs(fiber.config, fiber.first_node, position, expected, displacement);
    Long largest = 0, error = 0;
    for (std::size_t i = 0; i < position.size(); ++i) {
      const LongVec c = expected.change[i];
      largest = std::max(largest, std::hypot(c.x, c.y, c.z));
      error = std::max(error, std::hypot(c.x - change[i].x, c.y - change[i].y, c.z - change[i].z));
    }
    EXPECT_LT(static_cast<double>(error / largest), 5e-15)
        << shape.configs[0].sections << " sections of " << shape.configs[0].nodes_per_section << " nodes";
  }
}

TEST(SpringTangent, IsTheDerivativeOfTheForcesAndSymmetric) {
  for (const int nodes_per_section : {9, 66}) {
    const auto fibers = make_fibers({make_config(12, nodes_per_section, 0.3, 0.7), make_config(3, 5, 0.1, 1.9)});
    const SpringForces springs(fibers);
    const Nodes position = deform(fibers, 0.1, 3);
    const auto n = static_cast<int>(position.size());
    const auto forces_at = [&](const double h, const Nodes& moved) {
      const Vectors force("force", position.size());
      springs.add_forces(0.0, to_device("x", reference::shifted(position, h, moved)), force);
      return to_host(ConstVectors(force));
    };
    reference::Random random(7);
    const Nodes v = make_displacement(position.size()), w = reference::make_random_vectors(n, 1.0, random);
    constexpr double h = 2e-6;
    const Nodes change = change_by(springs, position, v);
    const Nodes twice = reference::shifted(forces_at(h, v), -1.0, forces_at(-h, v));
    EXPECT_LT(reference::norm_of(reference::shifted(change, -0.5 / h, twice)), 1e-7 * reference::norm_of(change));
    EXPECT_NEAR(reference::inner_product(w, change), reference::inner_product(v, change_by(springs, position, w)),
                1e-13 * reference::norm_of(change) * reference::norm_of(w));
  }
}

TEST(SpringTangent, AtSomeNodesHasTheBitsOfAll) {
  for (const Shape& shape : shapes()) {
    const auto fibers = make_fibers(shape.configs);
    const SpringForces springs(fibers);
    const Nodes position = deform(fibers, shape.deformation, 11), displacement = make_displacement(position.size());
    const Nodes all = change_by(springs, position, displacement);
    const int n = static_cast<int>(all.size()), edge = n / 3 + 1;
    for (const auto& [first, count] : {std::pair{0, edge}, std::pair{edge, n - edge}, std::pair{n - 1, 1}}) {
      const Vectors change("change", all.size());
      springs.add_force_changes_on(first, count, 0.0, {to_device("x", position), {}, to_device("u", displacement), {}},
                                   change);
      const Nodes some = to_host(ConstVectors(change));
      EXPECT_EQ(std::memcmp(&some[first], &all[first], count * sizeof(Vec3)), 0)
          << count << " nodes from " << first << " of " << n;
    }
  }
}

TEST(SpringTangent, OfSpringsOfLengthZeroIsZero) {
  const auto fibers = make_fibers({make_config(3, 7, 0.3, 0.7), make_config(3, 66, 0.3, 0.7)});
  const Nodes one_point(static_cast<std::size_t>(count_nodes(fibers)), Vec3{0.4, -1.0, 2.0});
  for (const auto& configs : {std::vector<FiberConfig>{fibers[0].config}, {fibers[0].config, fibers[1].config}}) {
    const auto some = make_fibers(configs);
    const Nodes at(one_point.begin(), one_point.begin() + count_nodes(some));
    for (const Vec3 c : change_by(SpringForces(some), at, make_displacement(at.size()))) EXPECT_EQ(norm(c), 0.0);
  }
}

TEST(SpringTangent, DoesNotHideWhatIsNoNumber) {
  const auto fibers = make_fibers({make_config(9, 7, 0.3, 0.7)});
  const Nodes position = deform(fibers, 0.1, 3), displacement = make_displacement(position.size());
  for (const bool is_displacement : {false, true}) {
    Nodes at = position, moved = displacement;
    (is_displacement ? moved : at)[30].y = NAN;
    const Nodes change = change_by(SpringForces(fibers), at, moved);
    EXPECT_TRUE(std::isnan(change[30].y) && std::isnan(change[31].y));
    EXPECT_FALSE(std::isnan(change[0].y));
  }
}

TEST(SpringTangent, RefusesArraysOfAnotherLength) {
  const SpringForces springs(make_fibers({make_config(3, 7, 0.3, 0.7)}));
  const Vectors right("right", 21), wrong("wrong", 20);
  EXPECT_THROW(springs.add_force_changes(0.0, wrong, right, right), Error);
  EXPECT_THROW(springs.add_force_changes(0.0, right, wrong, right), Error);
  EXPECT_THROW(springs.add_force_changes(0.0, right, right, wrong), Error);
}

}  // namespace
}  // namespace skein
