// Velocities of symmetric nodes by a part of them and its images against sums over all nodes.
#include <skein/core/error.hpp>
#include <skein/physics/direct_mobility.hpp>

#include "tests/unit/symmetric_case.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace skein {
namespace {

constexpr double viscosity = 1.7;

double relative_error(const std::vector<Vec3>& found, const std::vector<Vec3>& wanted) {
  double difference = 0.0, size = 0.0;
  for (std::size_t i = 0; i < wanted.size(); ++i) {
    difference = std::max(difference, norm(found[i] - wanted[i]));
    size = std::max(size, norm(wanted[i]));
  }
  return difference / size;
}

/// True where every node has exactly the image of the vector on its orbit's first node.
bool is_symmetric(const NodeOrbits& orbits, const std::vector<Vec3>& vectors) {
  for (int orbit = 0; orbit < orbits.n_orbits(); ++orbit)
    for (std::size_t element = 0; element < orbits.group.size(); ++element) {
      const int node = orbits.image_of(orbit, static_cast<int>(element));
      if (node >= 0 && !(vectors[static_cast<std::size_t>(node)] ==
                         orbits.group[element] * vectors[static_cast<std::size_t>(orbits.image_of(orbit, 0))]))
        return false;
    }
  return true;
}

TEST(SymmetricMobility, AgreesWithTheSumOverAllNodes) {
  DirectMobility direct(viscosity, Precision::in_double);
  for (const SymmetricCase& scene : list_symmetric_cases()) {
    const SymmetricSources nodes(scene);
    const auto wanted = nodes.compute(direct);
    for (const auto& [precision, tolerance] : {std::pair{Precision::in_double, 1e-13}, {Precision::in_single, 2e-6}}) {
      SymmetricMobility mobility(viscosity, precision, nodes.symmetry);
      const auto found = nodes.compute(mobility);
      const std::string where = scene.name + ", " + std::to_string(nodes.nodes.size()) + " nodes";
      EXPECT_LT(relative_error(found, wanted), tolerance) << where;
      EXPECT_TRUE(is_symmetric(nodes.symmetry->orbits(), found)) << where;
      EXPECT_EQ(nodes.compute(mobility), found) << where << ": a second call";
      const auto n = static_cast<double>(nodes.nodes.size());
      EXPECT_EQ(mobility.pairs(), 2.0 * n * n) << where;
    }
  }
}

// Velocities are added, not overwritten, and the fluid elsewhere feels all nodes.
TEST(SymmetricMobility, AddsToVelocitiesAndServesOtherTargets) {
  const SymmetricSources nodes(list_symmetric_cases()[2]);
  DirectMobility direct(viscosity, Precision::in_double);
  SymmetricMobility mobility(viscosity, Precision::automatic, nodes.symmetry);
  const auto once = nodes.compute(mobility);
  const std::vector<Vec3> before(nodes.nodes.size(), {0.1, 0.2, -0.3});
  const Vectors velocity = to_device("test::velocity", before);
  mobility.add_velocity(nodes.sources, nodes.sources.position, velocity);
  const auto both = to_host(ConstVectors(velocity));
  for (std::size_t i = 0; i < both.size(); ++i) EXPECT_LT(norm(both[i] - before[i] - once[i]), 1e-15);

  const ConstVectors target = to_device("test::target", {{0.3, 0.1, -0.2}, {0.0, 0.0, 0.0}});
  const Vectors there("test::there", 2), wanted("test::wanted", 2);
  mobility.add_velocity(nodes.sources, target, there);
  direct.add_velocity(nodes.sources, target, wanted);
  EXPECT_EQ(to_host(ConstVectors(there)), to_host(ConstVectors(wanted)));
  EXPECT_EQ(mobility.describe(), direct.describe()) << "no images made this sum";
}

// The fast multipole method is asked for first nodes only, and as good there as everywhere.
TEST(SymmetricMobility, SumsByTheFastMultipoleMethod) {
  using enum SymmetryAxis;
  const SymmetricSources nodes({"long", {z, z}, {make_tube(200, 12, {1.0, 0.5, 0.0})}});
  DirectMobility direct(viscosity, Precision::in_double);
  FmmOptions options;
  options.tolerance = 1e-5;
  options.check_every = 1;
  SymmetricMobility mobility(viscosity, options, nodes.symmetry);
  const auto found = nodes.compute(mobility), wanted = nodes.compute(direct);
  EXPECT_TRUE(is_symmetric(nodes.symmetry->orbits(), found));
  EXPECT_LT(relative_error(found, wanted), 1e-4) << "in the worst node; the tolerance is of all together";
  const ErrorRecord record = mobility.error_record();
  EXPECT_EQ(record.n_checks, 1);
  EXPECT_EQ(record.n_misses, 0);
  EXPECT_EQ(record.n_approximate, 1);
  EXPECT_GT(record.largest, 0.0);

  // Forces that are rounding beside the velocities are not judged.
  const Vectors flow = to_device(
      "test::flow", make_symmetric_vectors(nodes.symmetry->orbits(),
                                           CounterRandom(1, CounterRandom::Purpose::start_noise, 0), 0, 1e16));
  mobility.add_velocity(nodes.sources, nodes.sources.position, flow);
  EXPECT_EQ(mobility.error_record().n_checks, 1);
  EXPECT_EQ(mobility.error_record().n_approximate, 2);

  const ConstVectors target = to_device("test::target", {{0.3, 0.1, -0.2}, {0.0, 0.2, 0.0}});
  const Vectors there("test::there", 2), exact("test::exact", 2);
  mobility.add_velocity(nodes.sources, target, there);
  direct.add_velocity(nodes.sources, target, exact);
  EXPECT_LT(relative_error(to_host(ConstVectors(there)), to_host(ConstVectors(exact))), 1e-4);
}

// Mirrors halve the pairs and half turns do; nodes on the plane are weighed once.
TEST(SymmetricMobility, WeighsAsManyTimesFewerPairsAsTheGroupIsLarge) {
  const auto gain_of = [](const SymmetryConfig& symmetry, const FiberConfig& fiber) {
    const auto fibers = make_fibers({fiber});
    return make_node_orbits(symmetry, fibers, make_surface_nodes(fibers)).gain();
  };
  using enum SymmetryAxis;
  const FiberConfig tube = make_tube(80, 18, {1.0, 0.0, 0.0});
  EXPECT_EQ(gain_of({none, none}, tube), 1.0);
  EXPECT_EQ(gain_of({none, z}, tube), 2.0);
  EXPECT_NEAR(gain_of({z, none}, tube), 2.0, 0.03);
  EXPECT_NEAR(gain_of({z, z}, tube), 4.0, 0.06);
  EXPECT_EQ(gain_of({z, none}, make_bare_chain(100, {1.0, 0.0, 0.0})), 1.0);
  EXPECT_EQ(gain_of({z, z}, make_bare_chain(100, {1.0, 0.0, 0.0})), 2.0);
}

// The same fiber with its axes exchanged cyclically: x becomes y, y becomes z, z becomes x.
TEST(SymmetricMobility, DoesNotMindWhichAxesAreWhich) {
  using enum SymmetryAxis;
  const auto turn = [](const Vec3 v) { return Vec3{v.z, v.x, v.y}; };
  const SymmetricSources first({"first", {z, z}, {make_tube(41, 12, {1.0, 0.0, 0.0})}});
  std::vector<Vec3> nodes, forces;
  for (const Vec3 x : first.nodes) nodes.push_back(turn(x));
  for (const Vec3 f : to_host(first.sources.force)) forces.push_back(turn(f));
  NodeOrbits orbits = first.symmetry->orbits();
  orbits.group = make_group({make_mirror(x), make_half_turn(x)});
  for (OrbitClass& run : orbits.classes)
    for (SignMatrix& element : run.stabilizer)
      element.negated = ((element.negated << 1u) | (element.negated >> 2u)) & 7u;
  SymmetricMobility one(viscosity, Precision::in_double, first.symmetry),
      other(viscosity, Precision::in_double, std::make_shared<const NodeSymmetry>(orbits));
  const Sources sources{to_device("test::position", nodes), to_device("test::force", forces), first.sources.blob};
  const Vectors velocity("test::velocity", nodes.size());
  other.add_velocity(sources, sources.position, velocity);
  std::vector<Vec3> wanted;
  for (const Vec3 u : first.compute(one)) wanted.push_back(turn(u));
  EXPECT_LT(relative_error(to_host(ConstVectors(velocity)), wanted), 1e-13);
}

// Vectors of nodes that are not first are overwritten; those that cannot be but zero become zero.
TEST(NodeSymmetry, ProjectsToTheLastBit) {
  for (const SymmetricCase& scene : list_symmetric_cases()) {
    const SymmetricSources nodes(scene);
    std::vector<Vec3> vectors;
    for (std::size_t i = 0; i < nodes.nodes.size(); ++i)
      vectors.push_back({std::sin(1.0 * i), std::cos(2.0 * i), std::sin(3.0 + i)});
    const Vectors device = to_device("test::vectors", vectors);
    nodes.symmetry->project(device);
    const auto projected = to_host(ConstVectors(device));
    EXPECT_TRUE(is_symmetric(nodes.symmetry->orbits(), projected)) << scene.name;
    const unsigned vanishing = find_vanishing(nodes.symmetry->orbits().classes[0].stabilizer);
    EXPECT_EQ(projected[0], without_components(vanishing, vectors[0])) << scene.name;
    nodes.symmetry->project(device);
    EXPECT_EQ(to_host(ConstVectors(device)), projected) << scene.name;
  }
}

}  // namespace
}  // namespace skein
