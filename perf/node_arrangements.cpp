#include "node_arrangements.hpp"

#include <cmath>
#include <numbers>
#include <random>

namespace skein::perf {
namespace {

constexpr double radius = 0.005, spacing = 0.00173648;
constexpr int around = 18;

/// A circle of surface nodes about `center`, in the plane of two unit vectors.
void add_section(std::vector<Vec3>& nodes, const Vec3 center, const Vec3 one, const Vec3 other) {
  for (int a = 0; a < around; ++a) {
    const double angle = 2.0 * std::numbers::pi * a / around;
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

}  // namespace skein::perf
