#include <skein/core/error.hpp>
#include <skein/physics/spring_forces.hpp>

#include "device_list.hpp"
#include "force_table.hpp"
#include "kernels/spring_force.hpp"
#include "kernels/spring_tangent.hpp"

#include <algorithm>
#include <numeric>

namespace skein {
namespace {

/// Appends `count` times the index of the fiber.
void append_index(std::vector<int>& fiber_of, const int fiber, const int count) {
  fiber_of.insert(fiber_of.end(), count, fiber);
}

SpringArrays<ExecSpace> make_arrays(const std::vector<SpringNetwork>& networks) {
  std::vector<FiberSprings> fibers;
  std::vector<int> fiber_of_node, fiber_of_section, fiber_of_tile;
  std::vector<double> stiffness, inverse_rest_length, section_factor;
  int reach = 0;
  bool has_wide_sections = false;

  for (const SpringNetwork& network : networks) {
    const SpringStencil& stencil = network.stencil;
    const int index = static_cast<int>(fibers.size());
    SKEIN_REQUIRE(network.first_node == static_cast<int>(fiber_of_node.size()),
                  "fibers follow each other without gaps");
    fibers.push_back({.first_node = network.first_node,
                      .first_section = static_cast<int>(fiber_of_section.size()),
                      .first_tile = static_cast<int>(fiber_of_tile.size()),
                      .first_entry = static_cast<int>(stiffness.size()),
                      .n_sections = network.n_sections,
                      .nodes_per_section = stencil.nodes_per_section,
                      .reach = stencil.reach});
    append_index(fiber_of_node, index, network.n_nodes());
    append_index(fiber_of_section, index, network.n_sections);
    append_index(fiber_of_tile, index, math::ceil_div(network.n_sections, sections_per_tile));
    for (int section = 0; section < network.n_sections; ++section) section_factor.push_back(network.factor(section, 0));
    reach = std::max(reach, stencil.reach);
    has_wide_sections = has_wide_sections || stencil.nodes_per_section > max_tile_nodes;
    for (std::size_t entry = 0; entry < stencil.stiffness.size(); ++entry) {
      const bool is_spring = stencil.stiffness[entry] > 0.0;
      stiffness.push_back(is_spring ? stencil.stiffness[entry] : 0.0);
      // A node's spring to itself has no length; any finite number serves.
      inverse_rest_length.push_back(is_spring ? 1.0 / stencil.rest_length[entry] : 1.0);
    }
  }

  SpringArrays<ExecSpace> arrays;
  arrays.fiber = copy_to_device("skein::spring_fibers", fibers);
  arrays.fiber_of_node = copy_to_device("skein::fiber_of_node", fiber_of_node);
  arrays.fiber_of_section = copy_to_device("skein::fiber_of_section", fiber_of_section);
  arrays.fiber_of_tile = copy_to_device("skein::fiber_of_tile", fiber_of_tile);
  arrays.stiffness = to_device("skein::spring_stiffness", stiffness);
  arrays.inverse_rest_length = to_device("skein::inverse_rest_length", inverse_rest_length);
  arrays.section_factor = to_device("skein::section_factor", section_factor);
  arrays.has_wide_sections = has_wide_sections;
  if (on_host<ExecSpace>) arrays.reaction = Vectors("skein::spring_reaction", reach * fiber_of_node.size());
  return arrays;
}

}  // namespace

SpringForces::SpringForces(const std::vector<Fiber>& fibers, const KernelPath path)
    : SpringForces(make_spring_networks(fibers), path) {}

SpringForces::SpringForces(const std::vector<SpringNetwork>& networks, const KernelPath path)
    : springs_(std::make_unique<SpringArrays<ExecSpace>>(make_arrays(networks))),
      by_nodes_(path == KernelPath::device || !on_host<ExecSpace>) {
  for (const SpringNetwork& network : networks) {
    n_sections_.push_back(network.n_sections);
    reach_ = std::max(reach_, network.stencil.reach);
  }
  measures_ = std::make_unique<SpringMeasures<ExecSpace>>(
      SpringMeasures<ExecSpace>{FoundReals("skein::SpringForces::section_energy", springs_->fiber_of_section.extent(0)),
                                FoundReal("skein::SpringForces::largest_strain"),
                                Scalars("skein::SpringForces::node_energy", springs_->fiber_of_node.extent(0))});
}

SpringForces::~SpringForces() = default;
SpringForces::SpringForces(SpringForces&&) noexcept = default;
SpringForces& SpringForces::operator=(SpringForces&&) noexcept = default;

ForcePromises SpringForces::promises() const {
  return {.is_balanced = true,
          .is_torque_free = true,
          .is_conservative = true,
          .is_steady = true,
          .is_frame_indifferent = true,
          .reach = reach_};
}

void SpringForces::add_forces(double /*time*/, const ConstVectors& position, const Vectors& force) const {
  add_forces_on(0, position.extent_int(0), 0.0, {position, {}, {}, {}}, force);
}

void SpringForces::compute_forces(const double time, const ConstVectors& position, const Vectors& force) const {
  if (by_nodes_) return compute_spring_force_by_nodes<ExecSpace>(ExecSpace(), *springs_, position, force);
  Force::compute_forces(time, position, force);
}

void SpringForces::add_force_changes(double /*time*/, const ConstVectors& position, const ConstVectors& displacement,
                                     const Vectors& change) const {
  add_spring_force_change<ExecSpace>(ExecSpace(), *springs_, {0, position.extent_int(0)}, position, displacement,
                                     change);
}

void SpringForces::add_forces_on(const int first, const int n, double /*time*/, const SeenNodes& nodes,
                                 const Vectors& force) const {
  const ConstVectors& position = nodes.position;
  if (by_nodes_) return add_spring_force_by_nodes<ExecSpace>(ExecSpace(), *springs_, {first, n}, position, force);
  add_spring_force<ExecSpace>(ExecSpace(), *springs_, {first, n}, position, force);
}

void SpringForces::add_force_changes_on(const int first, const int n, double /*time*/, const SeenNodes& nodes,
                                        const Vectors& change) const {
  add_spring_force_change<ExecSpace>(ExecSpace(), *springs_, {first, n}, nodes.position, nodes.displacement, change);
}

void SpringForces::seek_measures(double /*time*/, const ConstVectors& position) const {
  seek_spring_measures<ExecSpace>(ExecSpace(), *springs_, position, *measures_);
}

void SpringForces::add_found_energies(std::vector<double>& energy) const {
  SKEIN_REQUIRE(energy.size() == n_sections_.size(), "one energy for each fiber");
  const double* section = measures_->section_energy.data();
  for (std::size_t f = 0; f < energy.size(); ++f) {
    energy[f] += std::accumulate(section, section + n_sections_[f], 0.0);
    section += n_sections_[f];
  }
}

double SpringForces::found_largest_strain() const {
  return std::max(0.0, measures_->largest_strain());  // of no springs, the reduction's smallest number
}

std::string SpringForces::describe() const { return "springs"; }

void append_springs(const SceneConfig& /*scene*/, const std::vector<Fiber>& fibers, ForceList& forces) {
  forces.push_back(std::make_unique<SpringForces>(fibers));
}

}  // namespace skein
