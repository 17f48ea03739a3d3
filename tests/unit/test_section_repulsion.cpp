#include <skein/physics/physics.hpp>
#include <skein/physics/section_repulsion.hpp>

#include "tests/reference/force_balance.hpp"
#include "tests/reference/point_cloud.hpp"
#include "tests/reference/regularized_stokeslet_reference.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

namespace skein {
namespace {

using Real = long double;

constexpr double strength = 2.3, range = 0.0071;

struct Tangle {
  std::vector<Fiber> fibers;
  std::vector<Vec3> position;
};

/// Fibers of different kinds along walks that keep their direction for a while, within a cube of about 0.1.
Tangle make_tangle(const std::uint64_t seed, const int n_fibers) {
  reference::Random random(seed);
  std::vector<FiberConfig> configs;
  for (int f = 0; f < n_fibers; ++f) {
    FiberConfig config;
    config.sections = 2 + static_cast<int>(random.bits() % 90);
    config.nodes_per_section = 3 + static_cast<int>(random.bits() % 5);
    config.radius = random.uniform(0.002, 0.006);
    configs.push_back(config);
  }
  Tangle tangle{make_fibers(configs), {}};
  for (const Fiber& fiber : tangle.fibers) {
    Vec3 point = random.in_cube(0.1), direction = random.direction();
    for (int s = 0; s < fiber.config.sections; ++s) {
      for (int a = 0; a < fiber.config.nodes_per_section; ++a)
        tangle.position.push_back(point + random.in_cube(fiber.config.radius));
      direction = direction + 0.5 * random.direction();
      direction = direction / norm(direction);
      point = point + (fiber.spacing() * random.uniform(0.2, 1.5)) * direction;
    }
  }
  return tangle;
}

struct Section {
  Real x[3];
  const Fiber* fiber;
  int number;  ///< on its fiber
};

std::vector<Section> sections_of(const Tangle& tangle) {
  std::vector<Section> sections;
  for (const Fiber& fiber : tangle.fibers)
    for (int s = 0; s < fiber.config.sections; ++s) {
      Section section{{0.0L, 0.0L, 0.0L}, &fiber, s};
      const int n = fiber.config.nodes_per_section;
      for (int a = 0; a < n; ++a) {
        const Vec3 node = tangle.position[fiber.first_node + s * n + a];
        section.x[0] += node.x / Real(n), section.x[1] += node.y / Real(n), section.x[2] += node.z / Real(n);
      }
      sections.push_back(section);
    }
  return sections;
}

struct Reference {
  std::vector<Vec3> force;     ///< [n_nodes]
  std::vector<double> energy;  ///< [n_fibers]
  int n_pairs_of_one = 0, n_pairs_of_two = 0;
};

/// All pairs, in long double.
Reference sum_all_pairs(const Tangle& tangle) {
  Reference result{std::vector<Vec3>(tangle.position.size()), std::vector<double>(tangle.fibers.size()), 0, 0};
  const auto sections = sections_of(tangle);
  for (const Section& one : sections) {
    Real f[3] = {0.0L, 0.0L, 0.0L}, energy = 0.0L;
    const FiberConfig& config = one.fiber->config;
    for (const Section& other : sections) {
      if (one.fiber == other.fiber && std::abs(one.number - other.number) * one.fiber->spacing() < 10.0 * config.radius)
        continue;
      Real d[3], square = 0.0L;
      for (int c = 0; c < 3; ++c) d[c] = one.x[c] - other.x[c], square += d[c] * d[c];
      const Real distance = std::sqrt(square), gap = distance - config.radius - other.fiber->config.radius;
      if (gap >= range) continue;
      ++(one.fiber == other.fiber ? result.n_pairs_of_one : result.n_pairs_of_two);
      const Real lengths = Real(one.fiber->spacing()) * other.fiber->spacing(), part = 1.0L - gap / range;
      energy += strength * lengths * part * part * part / 3.0L / 2.0L;
      for (int c = 0; c < 3; ++c) f[c] += strength * lengths * part * part / range * d[c] / distance;
    }
    result.energy[one.fiber->index] += static_cast<double>(energy);
    const int n = config.nodes_per_section;
    for (int a = 0; a < n; ++a)
      result.force[one.fiber->first_node + one.number * n + a] = {
          static_cast<double>(f[0] / n), static_cast<double>(f[1] / n), static_cast<double>(f[2] / n)};
  }
  return result;
}

std::vector<Vec3> forces_of(const SectionRepulsion& repulsion, const std::vector<Vec3>& position) {
  const Vectors force("force", position.size());
  repulsion.add_forces(0.0, to_device("position", position), force);
  return to_host(ConstVectors(force));
}

double energy_of(const SectionRepulsion& repulsion, const std::vector<Vec3>& position, const std::size_t n_fibers) {
  std::vector<double> energy(n_fibers);
  repulsion.add_energies(0.0, to_device("position", position), energy);
  double sum = 0.0;
  for (const double of_fiber : energy) sum += of_fiber;
  return sum;
}

TEST(SectionRepulsion, IsTheSumOverAllPairs) {
  int n_pairs_of_one = 0, n_pairs_of_two = 0;
  for (std::uint64_t seed = 0; seed < 24; ++seed) {
    const Tangle tangle = make_tangle(seed, seed % 4 == 0 ? 1 : static_cast<int>(2 * seed));
    const SectionRepulsion repulsion(tangle.fibers, strength, range);
    const Reference expected = sum_all_pairs(tangle);
    n_pairs_of_one += expected.n_pairs_of_one;
    n_pairs_of_two += expected.n_pairs_of_two;
    const auto force = forces_of(repulsion, tangle.position);
    EXPECT_LE(reference::norm_of(reference::shifted(force, -1.0, expected.force)),
              1e-12 * reference::norm_of(expected.force))
        << seed;
    std::vector<double> energy(tangle.fibers.size(), 0.75);  // it is added
    repulsion.add_energies(0.0, to_device("position", tangle.position), energy);
    for (std::size_t f = 0; f < energy.size(); ++f)
      EXPECT_NEAR(energy[f] - 0.75, expected.energy[f], 1e-12 * expected.energy[f] + 1e-15) << seed;
  }
  EXPECT_GT(n_pairs_of_one, 1000);
  EXPECT_GT(n_pairs_of_two, 10000);
}

TEST(SectionRepulsion, IsAddedToForces) {
  const Tangle tangle = make_tangle(5, 6);
  const SectionRepulsion repulsion(tangle.fibers, strength, range);
  const auto alone = forces_of(repulsion, tangle.position);
  const Vectors force = to_device("force", std::vector<Vec3>(alone.size(), Vec3{0.5, -2.0, 4.0}));
  repulsion.add_forces(0.0, to_device("position", tangle.position), force);
  const auto sum = to_host(ConstVectors(force));
  for (std::size_t i = 0; i < sum.size(); ++i) EXPECT_LT(norm(sum[i] - alone[i] - Vec3{0.5, -2.0, 4.0}), 1e-14);
}

TEST(SectionRepulsion, HasForcesThatAreMinusTheGradientOfTheEnergy) {
  const Tangle tangle = make_tangle(7, 12);
  const SectionRepulsion repulsion(tangle.fibers, strength, range);
  reference::Random random(8);
  const auto force = forces_of(repulsion, tangle.position);
  const double h = 1e-7;
  for (int i = 0; i < 5; ++i) {
    const auto v = reference::make_random_vectors(static_cast<int>(force.size()), 1.0, random);
    const double above = energy_of(repulsion, reference::shifted(tangle.position, h, v), tangle.fibers.size());
    const double below = energy_of(repulsion, reference::shifted(tangle.position, -h, v), tangle.fibers.size());
    EXPECT_NEAR((below - above) / (2.0 * h), reference::inner_product(force, v), 1e-6 * reference::norm_of(force)) << i;
  }
}

TEST(SectionRepulsion, HasChangesThatAreTheDerivativeOfTheForcesAndSymmetric) {
  const Tangle tangle = make_tangle(9, 12);
  const SectionRepulsion repulsion(tangle.fibers, strength, range);
  reference::Random random(10);
  const int n = static_cast<int>(tangle.position.size());
  const auto v = reference::make_random_vectors(n, 1.0, random), w = reference::make_random_vectors(n, 1.0, random);
  const auto change_by = [&](const std::vector<Vec3>& u) {
    const Vectors change("change", n);
    repulsion.add_force_changes(0.0, to_device("x", tangle.position), to_device("u", u), change);
    return to_host(ConstVectors(change));
  };
  const double h = 1e-8;
  const auto above = forces_of(repulsion, reference::shifted(tangle.position, h, v));
  const auto below = forces_of(repulsion, reference::shifted(tangle.position, -h, v));
  const auto change = change_by(v);
  EXPECT_LT(reference::norm_of(reference::shifted(change, -0.5 / h, reference::shifted(above, -1.0, below))),
            1e-5 * reference::norm_of(change));
  EXPECT_NEAR(reference::inner_product(w, change), reference::inner_product(v, change_by(w)),
              1e-12 * reference::norm_of(change) * reference::norm_of(w));
}

TEST(SectionRepulsion, PushesAndTurnsNothingAsAWhole) {
  const Tangle tangle = make_tangle(11, 15);
  const SectionRepulsion repulsion(tangle.fibers, strength, range);
  const auto force = forces_of(repulsion, tangle.position);
  const int n = static_cast<int>(force.size());
  const auto all = reference::sum_forces(tangle.position, force, 0, n);
  EXPECT_GT(all.size, 1e-3);
  EXPECT_LT(norm(all.net), 1e-14 * all.size);
  EXPECT_LT(norm(all.torque), 1e-14 * all.moment);
  // Fibers by themselves are pushed.
  double pushes = 0.0;
  for (const Fiber& fiber : tangle.fibers)
    pushes += norm(reference::sum_forces(tangle.position, force, fiber.first_node, fiber.n_nodes()).net);
  EXPECT_GT(pushes, 0.1 * all.size);

  // Their first moment, whatever the origin, is the sum of the fibers' shares.
  std::array<double, 6> sum{};
  std::vector<SymmetricTensor> moments(tangle.fibers.size());
  repulsion.add_moments(tangle.fibers, 0.0, to_device("position", tangle.position), moments);
  for (const auto& moment : moments)
    for (int c = 0; c < 6; ++c) sum[c] += moment[c];
  std::array<double, 6> expected{};
  for (int i = 0; i < n; ++i) {
    const Vec3 x = tangle.position[i] - Vec3{0.3, 0.1, -0.2}, f = force[i];
    const double parts[6] = {x.x * f.x, x.y * f.y, x.z * f.z, x.y * f.z, x.x * f.z, x.x * f.y};
    for (int c = 0; c < 6; ++c) expected[c] += parts[c];
  }
  for (int c = 0; c < 6; ++c) EXPECT_NEAR(sum[c], expected[c], 1e-13 * all.size) << c;
}

/// Straight fibers of length 0.1 and radius R, their centrelines `distance` apart in z.
Tangle make_two_straight(const double radius, const double distance, const int nodes_per_section,
                         const Vec3 direction) {
  FiberConfig one;
  one.radius = radius;
  one.nodes_per_section = nodes_per_section;
  one.sections = static_cast<int>(std::lround(0.1 / (2.0 * radius * std::sin(std::numbers::pi / nodes_per_section))));
  FiberConfig two = one;
  two.direction = direction;
  two.center = {0.0, 0.0, distance};
  Tangle tangle{make_fibers({one, two}), {}};
  tangle.position = make_surface_nodes(tangle.fibers);
  return tangle;
}

TEST(SectionRepulsion, PushesAsItSaysAtContact) {
  const double radius = 0.004, short_range = 0.02 * radius;
  // Whole fibers side by side, per length of the pair; the relative error of the first formula is of order range / R.
  const Tangle parallel = make_two_straight(radius, 2.0 * radius, 150, {1.0, 0.0, 0.0});
  auto force = forces_of(SectionRepulsion(parallel.fibers, strength, short_range), parallel.position);
  double push = 0.0;
  for (std::size_t i = force.size() / 2; i < force.size(); ++i) push += force[i].z;
  const double length = parallel.fibers[0].length();
  EXPECT_NEAR(push / length, 32.0 / 15.0 * strength * std::sqrt(radius / short_range), 0.02 * push / length);

  const Tangle crossing = make_two_straight(radius, 2.0 * radius, 150, {0.0, 1.0, 0.0});
  force = forces_of(SectionRepulsion(crossing.fibers, strength, short_range), crossing.position);
  push = 0.0;
  for (std::size_t i = force.size() / 2; i < force.size(); ++i) push += force[i].z;
  EXPECT_NEAR(push, 4.0 * std::numbers::pi / 3.0 * strength * radius, 0.02 * push);
}

TEST(SectionRepulsion, DoesNotDependOnTheNumberOfSections) {
  for (const Vec3 direction : {Vec3{1.0, 0.0, 0.0}, Vec3{0.3, 1.0, 0.0}}) {
    const auto energy = [&](const int nodes_per_section) {
      const Tangle pair = make_two_straight(0.004, 0.0095, nodes_per_section, direction);
      return energy_of(SectionRepulsion(pair.fibers, strength, 0.004), pair.position, 2);
    };
    const double fine = energy(72);
    EXPECT_GT(fine, 0.0);
    EXPECT_NEAR(energy(36), fine, 0.01 * fine);
    EXPECT_NEAR(energy(18), fine, 0.03 * fine);
    EXPECT_NEAR(energy(9), fine, 0.06 * fine);
  }
}

TEST(SectionRepulsion, LeavesNeighboursAndDistantFibersAlone) {
  Tangle straight = make_two_straight(0.005, 0.0301, 18, {1.0, 0.2, 0.0});
  // 4 radii of range: gaps of 0.0201 are beyond it, those between sections 10 radii apart on a fiber, too.
  for (const Vec3 f : forces_of(SectionRepulsion(straight.fibers, strength, 0.02), straight.position))
    EXPECT_EQ(f, (Vec3{}));
  EXPECT_EQ(energy_of(SectionRepulsion(straight.fibers, strength, 0.02), straight.position, 2), 0.0);
  EXPECT_GT(energy_of(SectionRepulsion(straight.fibers, strength, 0.0202), straight.position, 2), 0.0);
}

TEST(SectionRepulsion, IsFiniteWhereFibersCoincide) {
  const Tangle pair = make_two_straight(0.005, 0.0, 9, {1.0, 0.0, 0.0});
  const SectionRepulsion repulsion(pair.fibers, strength, range);
  double largest = 0.0;
  for (const Vec3 f : forces_of(repulsion, pair.position)) largest = std::max(largest, norm(f));
  EXPECT_GT(largest, 0.0);  // end sections are pushed outwards
  EXPECT_LT(largest, 10.0);
  EXPECT_TRUE(std::isfinite(energy_of(repulsion, pair.position, 2)));
  const Vectors change("change", pair.position.size());
  const Vectors x = to_device("x", pair.position);
  repulsion.add_force_changes(0.0, x, x, change);
  EXPECT_TRUE(std::isfinite(reference::norm_of(to_host(ConstVectors(change)))));
}

TEST(SectionRepulsion, IsMadeAsASceneSays) {
  const Tangle tangle = make_tangle(3, 5);
  double thinnest = std::numeric_limits<double>::infinity();
  for (const Fiber& fiber : tangle.fibers) thinnest = std::min(thinnest, fiber.config.radius);
  SceneConfig scene;
  const auto made = [&](const RepulsionConfig& config) {
    scene.fibers.clear();
    for (const Fiber& fiber : tangle.fibers) scene.fibers.push_back(fiber.config);
    scene.repulsion = config;
    return make_physics(scene).describe_forces();
  };
  EXPECT_EQ(made({0.0, 0.3}), "");
  EXPECT_EQ(made({1.5, 0.0}), SectionRepulsion(tangle.fibers, 1.5, thinnest).describe());
  EXPECT_EQ(made({1.5, 0.003}), SectionRepulsion(tangle.fibers, 1.5, 0.003).describe());
}

}  // namespace
}  // namespace skein
