#include <cmath>
#include <numbers>
#include <skein/core/error.hpp>
#include <skein/scene/fiber.hpp>

namespace skein {
namespace {

/// Axes of a fiber: along it, and those of angle 0 and 90 degrees on its sections; orthonormal and right-handed.
struct Axes {
  Vec3 along, angle_0, angle_90;
};

/// The axes x, y, z under the smallest rotation that takes x to the direction, then rolled about the direction.
/// This is continuous in the direction except at -x, where no choice is continuous for all neighbours (a sphere has no
/// continuous tangent field): there the axes are (-x, -y, z), the limit of turning within the x-y plane.
Axes make_axes(const Vec3 direction, const double roll_degrees) {
  const Vec3 d = direction / norm(direction);
  const double sideways_squared = d.y * d.y + d.z * d.z;
  // 1 + cos(angle to x), written without cancellation near -x.
  const double one_plus_cosine = d.x >= 0.0 ? 1.0 + d.x : sideways_squared / (1.0 - d.x);

  Vec3 y{0.0, -1.0, 0.0};
  Vec3 z{0.0, 0.0, 1.0};
  if (one_plus_cosine > 0.0) {
    const double skew = d.y * d.z / one_plus_cosine;
    y = {-d.y, 1.0 - d.y * d.y / one_plus_cosine, -skew};
    z = {-d.z, -skew, 1.0 - d.z * d.z / one_plus_cosine};
  }
  const double roll = roll_degrees * std::numbers::pi / 180.0;
  const double cosine = std::cos(roll);
  const double sine = std::sin(roll);
  return {d, cosine * y + sine * z, cosine * z - sine * y};
}

void append_nodes(const FiberConfig& config, const double spacing, std::vector<Vec3>& nodes) {
  const Axes axes = make_axes(config.direction, config.roll);
  for (int section = 0; section < config.sections; ++section) {
    const double arc = (section - 0.5 * (config.sections - 1)) * spacing;
    const Vec3 middle = config.center + arc * axes.along;
    for (int node = 0; node < config.nodes_per_section; ++node) {
      const double angle = 2.0 * std::numbers::pi * node / config.nodes_per_section;
      const double radius = config.radius;
      nodes.push_back(middle + radius * std::cos(angle) * axes.angle_0 + radius * std::sin(angle) * axes.angle_90);
    }
  }
}

}  // namespace

double Fiber::spacing() const { return 2.0 * config.radius * std::sin(std::numbers::pi / config.nodes_per_section); }

double Fiber::length() const { return config.sections * spacing(); }

std::vector<Fiber> make_fibers(const std::vector<FiberConfig>& configs) {
  std::vector<Fiber> fibers;
  int first_node = 0;
  int first_section = 0;
  for (const FiberConfig& config : configs) {
    SKEIN_REQUIRE(config.sections >= 2, "a fiber needs two sections");
    SKEIN_REQUIRE(config.nodes_per_section >= 3, "a section needs three nodes");
    SKEIN_REQUIRE(config.radius > 0.0, "the radius of a fiber is positive");
    SKEIN_REQUIRE(norm(config.direction) > 0.0, "the direction of a fiber is not the zero vector");
    const Fiber fiber{config, first_node, first_section};
    first_node += fiber.n_nodes();
    first_section += config.sections;
    fibers.push_back(fiber);
  }
  return fibers;
}

int count_nodes(const std::vector<Fiber>& fibers) {
  int n_nodes = 0;
  for (const Fiber& fiber : fibers) n_nodes += fiber.n_nodes();
  return n_nodes;
}

int count_sections(const std::vector<Fiber>& fibers) {
  int n_sections = 0;
  for (const Fiber& fiber : fibers) n_sections += fiber.config.sections;
  return n_sections;
}

std::vector<Vec3> make_surface_nodes(const std::vector<Fiber>& fibers) {
  std::vector<Vec3> nodes;
  nodes.reserve(count_nodes(fibers));
  for (const Fiber& fiber : fibers) append_nodes(fiber.config, fiber.spacing(), nodes);
  return nodes;
}

std::vector<double> make_blobs(const std::vector<Fiber>& fibers) {
  std::vector<double> blobs;
  blobs.reserve(count_nodes(fibers));
  for (const Fiber& fiber : fibers) blobs.insert(blobs.end(), fiber.n_nodes(), fiber.config.blob);
  return blobs;
}

}  // namespace skein
