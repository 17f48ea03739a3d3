#include "kernels/section_repulsion.hpp"

#include <skein/core/error.hpp>
#include <skein/physics/repulsion_range.hpp>
#include <skein/physics/section_repulsion.hpp>

#include "device_list.hpp"

#include <algorithm>
#include <limits>

namespace skein {
namespace {

SectionBoxes<ExecSpace> make_boxes(const std::vector<Fiber>& fibers) {
  std::vector<BoxedFiber> boxed;
  std::vector<int> fiber_of_run;
  for (const Fiber& fiber : fibers) {
    boxed.push_back({.first_node = fiber.first_node,
                     .first_section = fiber.first_section,
                     .first_run = static_cast<int>(fiber_of_run.size()),
                     .n_sections = fiber.config.sections,
                     .nodes_per_section = fiber.config.nodes_per_section,
                     .distant_sections = fiber.distant_sections(),
                     .radius = fiber.config.radius,
                     .spacing = fiber.spacing()});
    fiber_of_run.insert(fiber_of_run.end(), math::ceil_div(fiber.config.sections, sections_per_run),
                        static_cast<int>(boxed.size()) - 1);
  }
  const std::size_t n_fibers = boxed.size(), n_runs = fiber_of_run.size();
  SectionBoxes<ExecSpace> boxes;
  boxes.fiber = copy_to_device("skein::SectionBoxes::fiber", boxed);
  boxes.fiber_of_run = copy_to_device("skein::SectionBoxes::fiber_of_run", fiber_of_run);
  boxes.centroid = Vectors("skein::SectionBoxes::centroid", static_cast<std::size_t>(count_sections(fibers)));
  boxes.run_low = Vectors("skein::SectionBoxes::run_low", n_runs);
  boxes.run_high = Vectors("skein::SectionBoxes::run_high", n_runs);
  boxes.fiber_low = Vectors("skein::SectionBoxes::fiber_low", n_fibers);
  boxes.fiber_high = Vectors("skein::SectionBoxes::fiber_high", n_fibers);
  return boxes;
}

}  // namespace

SectionRepulsion::SectionRepulsion(const std::vector<Fiber>& fibers, const double strength, const double range)
    : strength_(strength),
      range_(range),
      n_nodes_(count_nodes(fibers)),
      boxes_(std::make_unique<SectionBoxes<ExecSpace>>(make_boxes(fibers))),
      displacement_("skein::SectionRepulsion::displacement", boxes_->centroid.extent(0)) {
  SKEIN_REQUIRE(strength >= 0.0 && range > 0.0, "a repulsion has a strength of 0 or more and a range above 0");
  for (const Fiber& fiber : fibers) n_sections_.push_back(fiber.config.sections);
}

SectionRepulsion::~SectionRepulsion() = default;
SectionRepulsion::SectionRepulsion(SectionRepulsion&&) noexcept = default;
SectionRepulsion& SectionRepulsion::operator=(SectionRepulsion&&) noexcept = default;

void SectionRepulsion::locate(const ConstVectors& position) const {
  SKEIN_REQUIRE(position.extent_int(0) == n_nodes_, "positions are those of the fibers' nodes");
  locate_sections<ExecSpace>(ExecSpace(), *boxes_, position);
}

void SectionRepulsion::add_forces(const ConstVectors& position, const Vectors& force) const {
  SKEIN_REQUIRE(force.extent(0) == position.extent(0), "one force for each position");
  locate(position);
  add_section_repulsion<ExecSpace>(ExecSpace(), *boxes_, {strength_, range_}, force);
}

void SectionRepulsion::add_force_changes(const ConstVectors& position, const ConstVectors& displacement,
                                         const Vectors& change) const {
  SKEIN_REQUIRE(displacement.extent(0) == position.extent(0) && change.extent(0) == position.extent(0),
                "one displacement and one change for each position");
  locate(position);
  compute_section_means<ExecSpace>(ExecSpace(), *boxes_, displacement, displacement_);
  add_section_repulsion_change<ExecSpace>(ExecSpace(), *boxes_, {strength_, range_}, displacement_, change);
}

void SectionRepulsion::add_energies(const ConstVectors& position, std::vector<double>& energy) const {
  SKEIN_REQUIRE(energy.size() == n_sections_.size(), "one energy for each fiber");
  locate(position);
  const Scalars of_section("skein::SectionRepulsion::energy", boxes_->centroid.extent(0));
  compute_repulsion_energy<ExecSpace>(ExecSpace(), *boxes_, {strength_, range_}, of_section);
  const std::vector<double> part = to_host(of_section);
  auto section = part.begin();
  for (std::size_t f = 0; f < energy.size(); ++f)
    for (const auto end = section + n_sections_[f]; section != end; ++section) energy[f] += *section;
}

std::vector<std::array<double, 6>> SectionRepulsion::compute_moments(const ConstVectors& position) const {
  locate(position);
  const Vectors diagonal("skein::SectionRepulsion::moment", boxes_->centroid.extent(0)),
      mixed("skein::SectionRepulsion::moment", boxes_->centroid.extent(0));
  compute_repulsion_moment<ExecSpace>(ExecSpace(), *boxes_, {strength_, range_}, diagonal, mixed);
  const auto on_diagonal = to_host(ConstVectors(diagonal)), off_diagonal = to_host(ConstVectors(mixed));
  std::vector<std::array<double, 6>> moments;
  std::size_t section = 0;
  for (const int count : n_sections_) {
    Vec3 a, b;
    for (const std::size_t end = section + static_cast<std::size_t>(count); section < end; ++section) {
      a = a + on_diagonal[section];
      b = b + off_diagonal[section];
    }
    moments.push_back({a.x, a.y, a.z, b.x, b.y, b.z});
  }
  return moments;
}

std::unique_ptr<SectionRepulsion> make_section_repulsion(const RepulsionConfig& config,
                                                         const std::vector<Fiber>& fibers) {
  if (config.strength == 0.0 || fibers.empty()) return nullptr;
  return std::make_unique<SectionRepulsion>(fibers, config.strength, find_repulsion_range(config, fibers));
}

}  // namespace skein
