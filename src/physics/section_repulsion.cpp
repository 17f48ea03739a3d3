#include "kernels/section_repulsion.hpp"

#include <skein/core/error.hpp>
#include <skein/physics/repulsion_range.hpp>
#include <skein/physics/section_repulsion.hpp>

#include "force_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

namespace skein {

SectionRepulsion::SectionRepulsion(const std::vector<Fiber>& fibers, const double strength, const double range)
    : strength_(strength),
      range_(range),
      sections_(fibers),
      displacement_("skein::SectionRepulsion::displacement", static_cast<std::size_t>(sections_.n_sections())),
      energy_("skein::SectionRepulsion::energy", static_cast<std::size_t>(sections_.n_sections())) {
  SKEIN_REQUIRE(strength >= 0.0 && range > 0.0, "a repulsion has a strength of 0 or more and a range above 0");
  for (const Fiber& fiber : fibers) n_sections_.push_back(fiber.config.sections);
}

ForcePromises SectionRepulsion::promises() const {
  return {.is_balanced = true,
          .is_torque_free = true,
          .is_conservative = true,
          .is_steady = true,
          .is_frame_indifferent = true,
          .acts_between_fibers = true,
          .reach = 0,
          .sees_centroids = true};
}

void SectionRepulsion::add_forces(const double time, const ConstVectors& position, const Vectors& force) const {
  add_forces_on(0, position.extent_int(0), time, {position, {}, {}, {}}, force);
}

void SectionRepulsion::add_force_changes(const double time, const ConstVectors& position,
                                         const ConstVectors& displacement, const Vectors& change) const {
  add_force_changes_on(0, position.extent_int(0), time, {position, {}, displacement, {}}, change);
}

void SectionRepulsion::add_forces_on(const int first, const int n, double /*time*/, const SeenNodes& nodes,
                                     const Vectors& force) const {
  SKEIN_REQUIRE(force.extent(0) == nodes.position.extent(0), "one force for each position");
  const SectionBlocks blocks = sections_.blocks_of(first, n);
  add_section_repulsion<ExecSpace>(ExecSpace(), locate(nodes), {strength_, range_}, {blocks.first, blocks.count},
                                   force);
}

void SectionRepulsion::add_force_changes_on(const int first, const int n, double /*time*/, const SeenNodes& nodes,
                                            const Vectors& change) const {
  SKEIN_REQUIRE(
      nodes.displacement.extent(0) == nodes.position.extent(0) && change.extent(0) == nodes.position.extent(0),
      "one displacement and one change for each position");
  ConstVectors mean = nodes.mean_displacement;
  if (!mean.is_allocated()) {
    sections_.compute_means(nodes.displacement, displacement_);
    mean = displacement_;
  }
  const SectionBlocks blocks = sections_.blocks_of(first, n);
  add_section_repulsion_change<ExecSpace>(ExecSpace(), locate(nodes), {strength_, range_}, {blocks.first, blocks.count},
                                          mean, change);
}

const SectionBoxes<ExecSpace>& SectionRepulsion::locate(const SeenNodes& nodes) const {
  return nodes.centroid.is_allocated() ? sections_.locate_at(nodes.centroid) : sections_.locate(nodes.position);
}

void SectionRepulsion::seek_measures(double /*time*/, const ConstVectors& position) const {
  compute_repulsion_energy<ExecSpace>(ExecSpace(), sections_.locate(position), {strength_, range_}, energy_);
}

void SectionRepulsion::add_found_energies(std::vector<double>& energy) const {
  SKEIN_REQUIRE(energy.size() == n_sections_.size(), "one energy for each fiber");
  const double* section = energy_.data();
  for (std::size_t f = 0; f < energy.size(); ++f)
    for (const double* const end = section + n_sections_[f]; section != end; ++section) energy[f] += *section;
}

void SectionRepulsion::add_moments(const std::vector<Fiber>& /*fibers*/, double /*time*/, const ConstVectors& position,
                                   std::vector<SymmetricTensor>& moment) const {
  SKEIN_REQUIRE(moment.size() == n_sections_.size(), "one moment for each fiber");
  const Vectors diagonal("skein::SectionRepulsion::moment", displacement_.extent(0)),
      mixed("skein::SectionRepulsion::moment", displacement_.extent(0));
  compute_repulsion_moment<ExecSpace>(ExecSpace(), sections_.locate(position), {strength_, range_}, diagonal, mixed);
  const auto on_diagonal = to_host(ConstVectors(diagonal)), off_diagonal = to_host(ConstVectors(mixed));
  std::size_t section = 0;
  for (std::size_t f = 0; f < moment.size(); ++f)
    for (const std::size_t end = section + static_cast<std::size_t>(n_sections_[f]); section < end; ++section) {
      const Vec3 a = on_diagonal[section], b = off_diagonal[section];
      const double part[6] = {a.x, a.y, a.z, b.x, b.y, b.z};
      for (int c = 0; c < 6; ++c) moment[f][c] += part[c];
    }
}

std::string SectionRepulsion::describe() const {
  return fmt::format("repulsion of strength {:g} where gaps are below {:g}", strength_, range_);
}

void append_repulsion(const SceneConfig& scene, const std::vector<Fiber>& fibers, ForceList& forces) {
  if (scene.repulsion.strength == 0.0 || fibers.empty()) return;
  forces.push_back(std::make_unique<SectionRepulsion>(fibers, scene.repulsion.strength,
                                                      find_repulsion_range(scene.repulsion, fibers)));
}

}  // namespace skein
