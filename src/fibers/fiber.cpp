#include <skein/core/error.hpp>
#include <skein/fibers/fiber.hpp>
#include <skein/fibers/start_shape.hpp>
#include <skein/scene/fiber_spacing.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace skein {
namespace {

void append_nodes(const Fiber& fiber, const std::uint64_t seed, std::vector<Vec3>& nodes) {
  for (const SectionPose& section : make_section_poses(fiber, seed)) append_section_nodes(fiber.config, section, nodes);
}

}  // namespace

void append_section_nodes(const FiberConfig& config, const SectionPose& section, std::vector<Vec3>& nodes) {
  if (config.nodes_per_section == 1) return nodes.push_back(section.center);
  for (int node = 0; node < config.nodes_per_section; ++node) {
    const double angle = 2.0 * std::numbers::pi * node / config.nodes_per_section;
    const double radius = config.radius;
    nodes.push_back(section.center + radius * std::cos(angle) * section.axes.angle_0 +
                    radius * std::sin(angle) * section.axes.angle_90);
  }
}

double Fiber::spacing() const { return compute_section_spacing(config); }

double Fiber::length() const { return config.sections * spacing(); }

int Fiber::distant_sections() const { return static_cast<int>(std::ceil(distant_radii * config.radius / spacing())); }

std::vector<Fiber> make_fibers(const std::vector<FiberConfig>& configs) {
  std::vector<Fiber> fibers;
  int first_node = 0;
  int first_section = 0;
  for (const FiberConfig& config : configs) {
    SKEIN_REQUIRE(config.sections >= 2, "a fiber needs two sections");
    SKEIN_REQUIRE(config.nodes_per_section >= 3 || config.is_line(), "a section needs three nodes");
    SKEIN_REQUIRE(!config.stands_for_tube(), "a line that stands for a tube is not laid out: see resolve_chains");
    SKEIN_REQUIRE(config.radius > 0.0, "the radius of a fiber is positive");
    SKEIN_REQUIRE(norm(config.direction) > 0.0, "the direction of a fiber is not the zero vector");
    const Fiber fiber{config, first_node, first_section, static_cast<int>(fibers.size())};
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

const Fiber& find_fiber_of(const std::vector<Fiber>& fibers, const int node) {
  return *std::find_if(fibers.begin(), fibers.end(),
                       [node](const Fiber& fiber) { return node < fiber.first_node + fiber.n_nodes(); });
}

double largest_length(const std::vector<Fiber>& fibers) {
  double length = 0.0;
  for (const Fiber& fiber : fibers) length = std::max(length, fiber.length());
  return length;
}

std::vector<Vec3> make_surface_nodes(const std::vector<Fiber>& fibers, const std::uint64_t seed) {
  std::vector<Vec3> nodes;
  nodes.reserve(count_nodes(fibers));
  for (const Fiber& fiber : fibers) append_nodes(fiber, seed, nodes);
  return nodes;
}

std::vector<double> make_blobs(const std::vector<Fiber>& fibers) {
  std::vector<double> blobs;
  blobs.reserve(count_nodes(fibers));
  for (const Fiber& fiber : fibers) blobs.insert(blobs.end(), fiber.n_nodes(), fiber.config.blob);
  return blobs;
}

}  // namespace skein
