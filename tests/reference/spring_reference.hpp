#pragma once

#include <skein/fibers/fiber.hpp>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

// Springs in long double, and fibers of many shapes to try them on.

namespace skein::reference {

using Long = long double;
struct LongVec {
  Long x = 0, y = 0, z = 0;
};

struct Elastic {
  std::vector<LongVec> force, change;
  Long energy = 0;

  explicit Elastic(const std::size_t n_nodes) : force(n_nodes), change(n_nodes) {}
};

/// Stiffness of a section relative to the fiber's: straight lines between the points of its profile.
inline Long profile_at(const FiberConfig& config, const int section) {
  const Long at = Long(section) / (config.sections - 1);
  const auto& points = config.stiffness_profile;
  if (at <= points.front().position) return points.front().factor;
  for (std::size_t i = 1; i < points.size(); ++i)
    if (at <= points[i].position)
      return points[i - 1].factor + (at - points[i - 1].position) * (Long(points[i].factor) - points[i - 1].factor) /
                                        (Long(points[i].position) - points[i - 1].position);
  return points.back().factor;
}

/// The springs again, in long double: every pair of nodes of a fiber that its reach joins, with the rest length
/// measured on the straight fiber along x. Shares no code with the library.
/// @param displacement  that the change of the forces is for; empty: none
inline void add_springs(const FiberConfig& config, const int first, const std::vector<Vec3>& position, Elastic& elastic,
                        const std::vector<Vec3>& displacement = {}) {
  const int n = config.nodes_per_section;
  const Long pi = std::acos(Long(-1));
  const Long spacing = 2 * Long(config.radius) * std::sin(pi / n);
  const auto rest = [&](const int i) {
    return LongVec{(i / n) * spacing, config.radius * std::cos(2 * pi * (i % n) / n),
                   config.radius * std::sin(2 * pi * (i % n) / n)};
  };
  for (int i = 0; i < config.sections * n; ++i) {
    for (int j = 0; j < i; ++j) {
      const int apart = i / n - j / n, around = std::min((i - j + 3 * n) % n, (j - i + config.sections * n) % n);
      if (apart > config.reach_along || (config.reach_around > 0 && around > config.reach_around)) continue;
      const Long family = apart == 0 ? config.stiffness_within_sections : config.stiffness_between_sections;
      const Long k = config.spring_stiffness * family * (profile_at(config, i / n) + profile_at(config, j / n)) / 2;
      const LongVec p = rest(i), q = rest(j);
      const Long l = std::sqrt((p.x - q.x) * (p.x - q.x) + (p.y - q.y) * (p.y - q.y) + (p.z - q.z) * (p.z - q.z));
      const Vec3 a = position[first + i], b = position[first + j];
      const LongVec d{Long(a.x) - b.x, Long(a.y) - b.y, Long(a.z) - b.z};
      const Long r = std::sqrt(d.x * d.x + d.y * d.y + d.z * d.z);
      elastic.energy += k * l * (r / l - 1) * (r / l - 1) / 2;
      if (r == 0) continue;
      const Long pull = -k * (r / l - 1) / r;
      LongVec &f = elastic.force[first + i], &g = elastic.force[first + j];
      f = {f.x + pull * d.x, f.y + pull * d.y, f.z + pull * d.z};
      g = {g.x - pull * d.x, g.y - pull * d.y, g.z - pull * d.z};
      if (displacement.empty()) continue;
      const Vec3 u = displacement[first + i], w = displacement[first + j];
      const LongVec v{Long(u.x) - w.x, Long(u.y) - w.y, Long(u.z) - w.z};
      const Long across = k * (1 / r - 1 / l), along = k * (d.x * v.x + d.y * v.y + d.z * v.z) / (r * r * r);
      const LongVec c{across * v.x - along * d.x, across * v.y - along * d.y, across * v.z - along * d.z};
      LongVec &a_change = elastic.change[first + i], &b_change = elastic.change[first + j];
      a_change = {a_change.x + c.x, a_change.y + c.y, a_change.z + c.z};
      b_change = {b_change.x - c.x, b_change.y - c.y, b_change.z - c.z};
    }
  }
}

inline FiberConfig make_config(const int sections, const int nodes_per_section, const double radius,
                               const double stiffness) {
  FiberConfig config;
  config.sections = sections;
  config.nodes_per_section = nodes_per_section;
  config.radius = radius;
  config.spring_stiffness = stiffness;
  config.direction = {0.3, -1.0, 0.8};
  return config;
}

/// Every node moved by up to `amount` radii in each direction.
inline std::vector<Vec3> deform(const std::vector<Fiber>& fibers, const double amount, const unsigned seed) {
  std::mt19937 generator(seed);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  std::vector<Vec3> position = make_surface_nodes(fibers);
  for (const Fiber& fiber : fibers)
    for (int i = 0; i < fiber.n_nodes(); ++i) {
      const Vec3 shift{uniform(generator), uniform(generator), uniform(generator)};
      position[fiber.first_node + i] = position[fiber.first_node + i] + amount * fiber.config.radius * shift;
    }
  return position;
}

/// Shapes of one or two fibers, with sections on both sides of the number of lanes that a tile has.
struct Shape {
  std::vector<FiberConfig> configs;
  double deformation;
};

inline std::vector<Shape> shapes() {
  std::vector<Shape> all;
  for (const int n : {3, 4, 7, 18})
    for (const int sections : {2, 3, 8, 9, 17})
      for (const double deformation : {0.02, 1.5}) all.push_back({{make_config(sections, n, 0.3, 0.7)}, deformation});
  all.push_back({{make_config(11, 18, 0.3, 0.7), make_config(7, 5, 0.05, 2.3)}, 0.1});
  all.push_back({{make_config(3, 70, 0.3, 0.7), make_config(4, 6, 0.1, 1.9)}, 0.1});  // more nodes than a tile holds
  // Springs that differ along the fiber and by family, and reach farther or less far.
  FiberConfig varied = make_config(13, 7, 0.3, 0.7);
  varied.stiffness_profile = {{0.1, 0.3}, {0.4, 2.5}, {0.95, 1.1}};
  varied.stiffness_within_sections = 1.7;
  varied.stiffness_between_sections = 0.4;
  FiberConfig far = make_config(11, 9, 0.2, 1.3);
  far.reach_along = 3;
  FiberConfig sparse = make_config(9, 68, 0.2, 1.3);
  sparse.reach_around = 2;
  sparse.stiffness_profile = {{0.0, 1.0}, {1.0, 3.0}};
  FiberConfig both = varied;
  both.reach_along = 2;
  both.reach_around = 1;
  for (const double deformation : {0.02, 0.5}) {
    all.push_back({{varied}, deformation});
    all.push_back({{far, varied}, deformation});
    all.push_back({{both, far}, deformation});
  }
  all.push_back({{sparse, both}, 0.1});
  return all;
}

}  // namespace skein::reference
