#include "node_arrangements.hpp"

#include <cmath>
#include <numbers>
#include <random>

namespace skein::perf {
namespace {

constexpr double radius = 0.005, spacing = 0.00173648;
constexpr int around = 18;

/// A circle of surface nodes about `center`, in the plane of two unit vectors.
void add_section(std::vector<Vec3>& nodes, const Vec3 center, const Vec3 one, const Vec3 other,
                 const int n_around = around) {
  for (int a = 0; a < n_around; ++a) {
    const double angle = 2.0 * std::numbers::pi * a / n_around;
    nodes.push_back(center + radius * std::cos(angle) * one + radius * std::sin(angle) * other);
  }
}

}  // namespace

std::vector<Vec3> make_straight(const int n_nodes) {
  std::vector<Vec3> nodes;
  for (int s = 0; s < n_nodes / around; ++s)
    add_section(nodes, {(s - 0.5 * (n_nodes / around - 1)) * spacing, 0.0, 0.0}, {0.0, 1.0, 0.0}, {0.0, 0.0, 1.0});
  return nodes;
}

double tube_length(const int n_nodes) { return n_nodes * spacing / around; }

std::vector<Vec3> make_spiral(const int n_nodes) {
  constexpr double pitch = 0.03, growth = pitch / (2.0 * std::numbers::pi);
  std::vector<Vec3> nodes;
  double angle = 2.0 * std::numbers::pi;
  for (int s = 0; s < n_nodes / around; ++s) {
    const double r = growth * angle, c = std::cos(angle), i = std::sin(angle);
    const Vec3 along{growth * c - r * i, growth * i + r * c, 0.0};
    const double speed = norm(along);
    add_section(nodes, {r * c, r * i, 0.0}, {-along.y / speed, along.x / speed, 0.0}, {0.0, 0.0, 1.0});
    angle += spacing / speed;
  }
  return nodes;
}

std::vector<Vec3> make_uniform(const int n_nodes) {
  std::mt19937_64 random(3);
  std::uniform_real_distribution<double> uniform(0.0, 1.0);
  std::vector<Vec3> nodes(static_cast<std::size_t>(n_nodes));
  for (Vec3& node : nodes) node = {uniform(random), uniform(random), uniform(random)};
  return nodes;
}

std::vector<Vec3> make_suspension(const int n_fibers, const int n_sections, const int n_around) {
  constexpr double in_a_cube = 5.0;  // fibers in a cube of their length
  const double section_spacing = 2.0 * std::numbers::pi * radius / n_around, length = n_sections * section_spacing;
  std::mt19937_64 random(4);
  std::uniform_real_distribution<double> place(0.0, length * std::cbrt(n_fibers / in_a_cube));
  std::normal_distribution<double> normal;
  const auto unit = [](const Vec3 v) { return v / norm(v); };
  std::vector<Vec3> nodes;
  for (int f = 0; f < n_fibers; ++f) {
    const Vec3 start{place(random), place(random), place(random)};
    const Vec3 along = unit({normal(random), normal(random), normal(random)});
    const Vec3 one = unit(cross(along, {normal(random), normal(random), normal(random)}));
    for (int s = 0; s < n_sections; ++s)
      add_section(nodes, start + (s * section_spacing) * along, one, cross(along, one), n_around);
  }
  return nodes;
}

}  // namespace skein::perf
