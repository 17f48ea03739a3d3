// Nodes inside of surfaces: straight tubes, whose depths are known, and deformed ones, against rays through all
// triangles.
#include <skein/physics/sections.hpp>

#include "tests/reference/point_cloud.hpp"
#include "tests/reference/winding_number.hpp"
#include "tests/support/rotation.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace skein {
namespace {

constexpr double pi = std::numbers::pi;
constexpr double radius = 0.05;

FiberConfig make_config(const int sections, const int nodes_per_section = 18) {
  FiberConfig config;
  config.sections = sections;
  config.nodes_per_section = nodes_per_section;
  config.radius = radius;
  return config;
}

Penetration penetration_of(const std::vector<Fiber>& fibers, const std::vector<Vec3>& position) {
  const Vectors on_device = to_device("position", position);
  const Penetration found = Sections(fibers).compute_penetration(on_device);
  const Penetration looked = Sections(fibers).look(on_device).penetration;
  EXPECT_EQ(looked.nodes, found.nodes);
  EXPECT_EQ(looked.depth, found.depth);
  return found;
}

/// A straight tube along x about the origin, turned and moved.
struct PlacedTube {
  FiberConfig config;
  test::Rotation turn{{1.0, 0.0, 0.0}, 0.0};
  Vec3 center;

  std::vector<Vec3> nodes() const {
    auto nodes = turn(make_surface_nodes(make_fibers({config})));
    for (Vec3& x : nodes) x = x + center;
    return nodes;
  }

  /// Of a point in the prism with a regular polygon for its section: distance to the nearest face; not above 0 outside.
  double depth_of(const Vec3 point) const {
    const Vec3 x = test::Rotation{turn.axis, -turn.angle}(point - center);
    const int n = config.nodes_per_section;
    const Fiber fiber = make_fibers({config})[0];
    double depth = 0.5 * (config.sections - 1) * fiber.spacing() - std::abs(x.x);
    for (int face = 0; face < n; ++face) {
      const double angle = 2.0 * pi * (face + 0.5) / n;
      depth = std::min(depth, config.radius * std::cos(pi / n) - std::cos(angle) * x.y - std::sin(angle) * x.z);
    }
    return depth;
  }
};

Penetration expected_of(const PlacedTube& one, const PlacedTube& other) {
  Penetration expected;
  const auto take = [&](const double depth) {
    expected.nodes += depth > 0.0;
    expected.depth = std::max(expected.depth, depth);
  };
  for (const Vec3 x : one.nodes()) take(other.depth_of(x));
  for (const Vec3 x : other.nodes()) take(one.depth_of(x));
  return expected;
}

Penetration found_between(const PlacedTube& one, const PlacedTube& other) {
  auto position = one.nodes();
  const auto more = other.nodes();
  position.insert(position.end(), more.begin(), more.end());
  return penetration_of(make_fibers({one.config, other.config}), position);
}

TEST(Penetration, OfStraightTubesIsTheDistanceToTheNearestFace) {
  int n_inside = 0;
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    reference::Random random(seed);
    PlacedTube one{make_config(30), {}, random.in_cube(0.1)};
    PlacedTube other{make_config(12 + static_cast<int>(seed % 20), 6 + static_cast<int>(seed % 9)),
                     test::make_random_rotation(random), random.in_cube(0.1)};
    const Penetration expected = expected_of(one, other), found = found_between(one, other);
    EXPECT_EQ(found.nodes, expected.nodes) << seed;
    EXPECT_NEAR(found.depth, expected.depth, 1e-14) << seed;
    n_inside += expected.nodes > 0;
  }
  EXPECT_GT(n_inside, 100);
  EXPECT_LT(n_inside, 200);
}

// A row of nodes of the shorter tube lies along a face of the longer one: all of it is inside, or none, and on the face
// itself, to 1e-9 radii, none whichever way rounding goes.
TEST(Penetration, BeginsAtTheSurface) {
  const double face_angle = pi / 18.0;
  const PlacedTube one{make_config(30), {}, {}};
  for (const double depth : {-1e-3, -1e-9, -1e-12, -1e-16, 0.0, 1e-16, 1e-12, 1e-11, 1e-9, 1e-3}) {
    const double distance = radius * std::cos(pi / 18.0) + radius - depth;
    const PlacedTube other{make_config(20),
                           {{1.0, 0.0, 0.0}, face_angle},
                           {0.003, distance * std::cos(face_angle), distance * std::sin(face_angle)}};
    const Penetration found = found_between(one, other);
    const bool is_inside = depth > 1e-9 * radius;
    EXPECT_EQ(found.nodes, is_inside ? 20 : 0) << depth;
    EXPECT_NEAR(found.depth, is_inside ? depth : 0.0, 1e-15) << depth;
  }
}

// Rings at the same places as those of the tube around: nodes lie on the faces that prisms share.
TEST(Penetration, OfATubeInAWiderOneCountsEveryNodeOnce) {
  FiberConfig inner = make_config(9), outer = make_config(29);
  outer.radius = 2.0 * radius;
  outer.nodes_per_section = 36;
  const auto spacing_of = [](const FiberConfig& config) { return make_fibers({config})[0].spacing(); };
  ASSERT_NEAR(spacing_of(inner), spacing_of(outer), 3e-4);
  auto position = PlacedTube{inner, {}, {}}.nodes();
  for (Vec3& x : position) x.x *= spacing_of(outer) / spacing_of(inner);
  for (const Vec3 x : PlacedTube{outer, {}, {}}.nodes()) position.push_back(x);
  const Penetration found = penetration_of(make_fibers({inner, outer}), position);
  EXPECT_EQ(found.nodes, 9 * 18);
  EXPECT_NEAR(found.depth, (outer.radius - radius) * std::cos(pi / 36.0), 1e-14);
}

/// A walk of rings that keep neither their radius nor their plane.
std::vector<Vec3> make_deformed_tube(const Fiber& fiber, const double roughness, reference::Random& random) {
  std::vector<Vec3> nodes;
  Vec3 point = random.in_cube(0.04), along = random.direction(), side = cross(along, random.direction());
  for (int section = 0; section < fiber.config.sections; ++section) {
    along = along + 0.15 * random.direction() - 3.0 * point;  // it stays where the others are
    along = along / norm(along);
    side = side - dot(side, along) * along;
    side = side / norm(side);
    point = point + fiber.spacing() * along;
    const int n = fiber.config.nodes_per_section;
    for (int a = 0; a < n; ++a) {
      const double angle = 2.0 * pi * a / n, size = fiber.config.radius * random.uniform(1.0 - roughness, 1.0);
      nodes.push_back(point + size * (std::cos(angle) * side + std::sin(angle) * cross(along, side)) +
                      0.3 * roughness * random.in_cube(fiber.spacing()));
    }
  }
  return nodes;
}

/// Part of a list.
std::vector<Vec3> slice(const std::vector<Vec3>& nodes, const int first, const int end) {
  return {nodes.begin() + first, nodes.begin() + end};
}

/// Depth of a node in rings [first, end) of a tube, by rays; negative where it is outside.
class BruteForce {
 public:
  BruteForce(const std::vector<Fiber>& fibers, const std::vector<Vec3>& position)
      : fibers_(fibers), position_(position) {}

  Penetration look() const {
    Penetration found;
    for (const Fiber& fiber : fibers_)
      for (int section = 0; section < fiber.config.sections; ++section)
        for (int a = 0; a < fiber.config.nodes_per_section; ++a) {
          const int node = fiber.first_node + section * fiber.config.nodes_per_section + a;
          const double depth = depth_of(fiber, section, position_[node]);
          found.nodes += depth > 0.0;
          found.depth = std::max(found.depth, depth);
        }
    return found;
  }

 private:
  double depth_of(const Fiber& own, const int section, const Vec3 point) const {
    double depth = 0.0;
    for (const Fiber& fiber : fibers_) {
      const int n = fiber.config.sections;
      std::vector<reference::Triangle> closed, surface;
      const auto add_part = [&](const int first, const int end) {
        if (end - first < 2) return;
        const int m = fiber.config.nodes_per_section;
        const auto tube =
            reference::make_tube(slice(position_, fiber.first_node + first * m, fiber.first_node + end * m), m);
        for (const auto* part : {&tube.sides, &tube.first_end, &tube.last_end})
          closed.insert(closed.end(), part->begin(), part->end());
        surface.insert(surface.end(), tube.sides.begin(), tube.sides.end());
        if (first == 0) surface.insert(surface.end(), tube.first_end.begin(), tube.first_end.end());
        if (end == n) surface.insert(surface.end(), tube.last_end.begin(), tube.last_end.end());
      };
      if (fiber.index == own.index) {
        const int distant = static_cast<int>(std::ceil(10.0 * fiber.config.radius / fiber.spacing() - 1e-9));
        add_part(0, std::max(0, section - distant + 1));
        add_part(std::min(n, section + distant), n);
      } else {
        add_part(0, n);
      }
      if (reference::count_windings(closed, point) > 0)
        depth = std::max(depth, reference::compute_distance(surface, point));
    }
    return depth;
  }

  const std::vector<Fiber>& fibers_;
  const std::vector<Vec3>& position_;
};

TEST(Penetration, OfDeformedFibersAgreesWithRaysThroughAllTriangles) {
  int n_inside = 0;
  for (std::uint64_t seed = 0; seed < 24; ++seed) {
    reference::Random random(seed);
    std::vector<FiberConfig> configs;
    for (int f = 0; f < 2 + static_cast<int>(seed % 3); ++f)
      configs.push_back(make_config(2 + static_cast<int>(random.bits() % 40), 3 + static_cast<int>(random.bits() % 7)));
    const auto fibers = make_fibers(configs);
    std::vector<Vec3> position;
    for (const Fiber& fiber : fibers)
      for (const Vec3 x : make_deformed_tube(fiber, 0.6, random)) position.push_back(x);
    const Penetration expected = BruteForce(fibers, position).look(), found = penetration_of(fibers, position);
    EXPECT_EQ(found.nodes, expected.nodes) << seed;
    EXPECT_NEAR(found.depth, expected.depth, 1e-13) << seed;
    n_inside += expected.nodes;

    const test::Rotation turn = test::make_random_rotation(random);
    const Penetration turned = penetration_of(fibers, turn(position));
    EXPECT_EQ(turned.nodes, found.nodes) << seed;
    EXPECT_NEAR(turned.depth, found.depth, 1e-13) << seed;
  }
  EXPECT_GT(n_inside, 200);
}

/// A coil of pitch 2 pi `rise`: its turns stick in each other where the pitch is below two radii.
std::vector<Vec3> make_coil(const Fiber& fiber, const double coil_radius, const double rise) {
  std::vector<Vec3> nodes;
  for (int section = 0; section < fiber.config.sections; ++section) {
    const double turn = section * fiber.spacing() / coil_radius;
    const Vec3 out{std::cos(turn), std::sin(turn), 0.0}, along{-std::sin(turn), std::cos(turn), rise / coil_radius};
    const Vec3 tangent = along / norm(along), up = cross(tangent, out);
    const int n = fiber.config.nodes_per_section;
    for (int a = 0; a < n; ++a)
      nodes.push_back(coil_radius * out + Vec3{0.0, 0.0, rise * turn} +
                      fiber.config.radius * (std::cos(2.0 * pi * a / n) * out + std::sin(2.0 * pi * a / n) * up));
  }
  return nodes;
}

TEST(Penetration, OfOnePartOfAFiberInAnotherIsSeenAndThatOfNeighboursIsNot) {
  const auto fibers = make_fibers({make_config(90, 9)});
  for (const double rise : {0.6, 0.9, 1.2}) {
    const auto position = make_coil(fibers[0], 0.2, rise * 2.0 * radius / (2.0 * pi));
    const Penetration expected = BruteForce(fibers, position).look(), found = penetration_of(fibers, position);
    EXPECT_EQ(found.nodes, expected.nodes) << rise;
    EXPECT_NEAR(found.depth, expected.depth, 1e-14) << rise;
    EXPECT_EQ(found.nodes > 0, rise < 1.0);
  }
  // Bent until its rings pass through each other, but nowhere distant from itself.
  const auto hook = make_fibers({make_config(12, 9)});
  EXPECT_EQ(penetration_of(hook, make_coil(hook[0], 0.5 * radius, 0.0)).nodes, 0);
}

// Its nodes may be inside of a tube; a tube's nodes are not inside of it, whatever crosses what.
TEST(Penetration, OfAChainIsThatOfItsNodesAlone) {
  FiberConfig chain = make_config(21, 1);
  chain.model = FiberModel::chain;
  chain.spacing = 0.03;
  chain.direction = {0.0, 1.0, 0.0};
  const auto fibers = make_fibers({make_config(30), chain, make_config(30, 6)});
  auto nodes = make_surface_nodes(fibers);
  for (int i = fibers[2].first_node; i < fibers[2].first_node + fibers[2].n_nodes(); ++i) nodes[i].z += 10.0 * radius;
  const Penetration found = penetration_of(fibers, nodes);
  EXPECT_EQ(found.nodes, 3);  // at y = -0.03, 0 and 0.03
  EXPECT_NEAR(found.depth, radius * std::cos(pi / 18), 1e-14);
}

}  // namespace
}  // namespace skein
