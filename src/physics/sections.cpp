#include <skein/arrays/launch.hpp>
#include <skein/core/error.hpp>
#include <skein/physics/sections.hpp>

#include "device_list.hpp"
#include "kernels/penetration.hpp"
#include "kernels/section_boxes.hpp"
#include "kernels/section_fault.hpp"
#include "kernels/section_gap.hpp"
#include "kernels/tube_surface.hpp"

#include <algorithm>

namespace skein {
namespace {

std::vector<FiberSections> list_sections(const std::vector<Fiber>& fibers) {
  std::vector<FiberSections> boxed;
  int n_blocks = 0;
  for (const Fiber& fiber : fibers) {
    boxed.push_back({.first_node = fiber.first_node,
                     .first_section = fiber.first_section,
                     .first_block = n_blocks,
                     .n_sections = fiber.config.sections,
                     .nodes_per_section = fiber.config.nodes_per_section,
                     .distant_sections = fiber.distant_sections(),
                     .radius = fiber.config.radius,
                     .spacing = fiber.spacing()});
    n_blocks = boxed.back().end_block();
  }
  return boxed;
}

SectionBoxes<ExecSpace> make_boxes(const std::vector<FiberSections>& boxed, const int n_sections) {
  std::vector<int> fiber_of_block;
  for (std::size_t f = 0; f < boxed.size(); ++f)
    fiber_of_block.resize(static_cast<std::size_t>(boxed[f].end_block()), static_cast<int>(f));
  const std::size_t n_fibers = boxed.size(), n_blocks = fiber_of_block.size();
  SectionBoxes<ExecSpace> boxes;
  boxes.fiber = copy_to_device("skein::SectionBoxes::fiber", boxed);
  boxes.fiber_of_block = copy_to_device("skein::SectionBoxes::fiber_of_block", fiber_of_block);
  boxes.centroid = Vectors("skein::SectionBoxes::centroid", static_cast<std::size_t>(n_sections));
  boxes.block_low = Vectors("skein::SectionBoxes::block_low", n_blocks);
  boxes.block_high = Vectors("skein::SectionBoxes::block_high", n_blocks);
  boxes.fiber_low = Vectors("skein::SectionBoxes::fiber_low", n_fibers);
  boxes.fiber_high = Vectors("skein::SectionBoxes::fiber_high", n_fibers);
  return boxes;
}

TubeSurfaces<ExecSpace> make_surfaces(const SectionBoxes<ExecSpace>& boxes) {
  const std::size_t n_fibers = boxes.fiber.extent(0), n_blocks = boxes.fiber_of_block.extent(0),
                    n_sections = boxes.centroid.extent(0);
  TubeSurfaces<ExecSpace> surfaces;
  surfaces.sections = boxes;
  surfaces.ring_low = Vectors("skein::TubeSurfaces::ring_low", n_sections);
  surfaces.ring_high = Vectors("skein::TubeSurfaces::ring_high", n_sections);
  surfaces.block_low = Vectors("skein::TubeSurfaces::block_low", n_blocks);
  surfaces.block_high = Vectors("skein::TubeSurfaces::block_high", n_blocks);
  surfaces.fiber_low = Vectors("skein::TubeSurfaces::fiber_low", n_fibers);
  surfaces.fiber_high = Vectors("skein::TubeSurfaces::fiber_high", n_fibers);
  return surfaces;
}

}  // namespace

Sections::Sections(const std::vector<Fiber>& fibers)
    : n_nodes_(count_nodes(fibers)),
      n_sections_(count_sections(fibers)),
      fibers_(std::make_unique<std::vector<FiberSections>>(list_sections(fibers))),
      boxes_(std::make_unique<SectionBoxes<ExecSpace>>(make_boxes(*fibers_, n_sections_))),
      surfaces_(std::make_unique<TubeSurfaces<ExecSpace>>(make_surfaces(*boxes_))),
      depth_("skein::Sections::depth", static_cast<std::size_t>(n_nodes_)),
      faulty_node_("skein::Sections::faulty_node"),
      n_inside_("skein::Sections::n_inside"),
      gap_("skein::Sections::gap"),
      centreline_("skein::Sections::centreline", static_cast<std::size_t>(n_sections_)) {}

Sections::~Sections() = default;
Sections::Sections(Sections&&) noexcept = default;
Sections& Sections::operator=(Sections&&) noexcept = default;

void Sections::seek_faulty_node(const ConstVectors& position, const double max_ratio) const {
  SKEIN_REQUIRE(position.extent_int(0) == n_nodes_, "positions are those of the fibers' nodes");
  skein::seek_faulty_node<ExecSpace>(ExecSpace(), *boxes_, position, max_ratio, faulty_node_);
}

int Sections::found_faulty_node() const { return faulty_node_() == no_node ? -1 : faulty_node_(); }

int Sections::find_faulty_node(const ConstVectors& position, const double max_ratio) const {
  seek_faulty_node(position, max_ratio);
  wait_for(ExecSpace());
  return found_faulty_node();
}

void Sections::compute_means(const ConstVectors& vector, const Vectors& mean) const {
  SKEIN_REQUIRE(vector.extent_int(0) == n_nodes_, "a vector for each of the fibers' nodes is needed");
  compute_section_means<ExecSpace>(ExecSpace(), *boxes_, all_blocks<ExecSpace>(*boxes_), vector, mean);
}

void Sections::compute_means_on(const int first, const int n, const ConstVectors& vector, const Vectors& mean) const {
  SKEIN_REQUIRE(vector.extent_int(0) == n_nodes_, "a vector for each of the fibers' nodes is needed");
  const SectionBlocks blocks = blocks_of(first, n);
  compute_section_means<ExecSpace>(ExecSpace(), *boxes_, {blocks.first, blocks.count}, vector, mean);
}

SectionBlocks Sections::blocks_of(const int first, const int n) const {
  if (n == 0) return {};
  const auto block_of = [this](const int node) {
    const auto next = std::find_if(fibers_->begin(), fibers_->end(), [node](const FiberSections& fiber) {
      return node < fiber.first_node + fiber.n_sections * fiber.nodes_per_section;
    });
    return next->first_block + (node - next->first_node) / next->nodes_per_section / sections_per_block;
  };
  const int first_block = block_of(first);
  return {first_block, block_of(first + n - 1) + 1 - first_block};
}

std::vector<Vec3> Sections::compute_centreline(const ConstVectors& position) const {
  compute_means(position, boxes_->centroid);
  return to_host(ConstVectors(boxes_->centroid));
}

double Sections::compute_smallest_gap(const ConstVectors& position) const {
  seek_smallest_gap<ExecSpace>(ExecSpace(), locate(position), gap_);
  wait_for(ExecSpace());
  return found_gap(gap_);
}

void Sections::seek_penetration(const ConstVectors& position) const {
  SKEIN_REQUIRE(position.extent_int(0) == n_nodes_, "positions are those of the fibers' nodes");
  TubeSurfaces<ExecSpace> surfaces = *surfaces_;
  surfaces.position = position;
  locate_surfaces<ExecSpace>(ExecSpace(), surfaces);
  seek_nodes_inside<ExecSpace>(ExecSpace(), surfaces, depth_, n_inside_);
}

/// After a wait.
Penetration Sections::found_penetration() const {
  const int n = n_inside_();
  return {n, n == 0 ? 0.0 : find_largest_depth<ExecSpace>(ExecSpace(), depth_)};
}

Penetration Sections::compute_penetration(const ConstVectors& position) const {
  seek_penetration(position);
  wait_for(ExecSpace());
  return found_penetration();
}

void Sections::seek(const ConstVectors& position) const {
  seek_penetration(position);
  Kokkos::deep_copy(ExecSpace(), centreline_, boxes_->centroid);
  seek_smallest_gap<ExecSpace>(ExecSpace(), *boxes_, gap_);
}

SectionRecord Sections::found() const {
  SectionRecord record;
  record.centreline.reserve(centreline_.extent(0));
  for (int section = 0; section < n_sections_; ++section) record.centreline.push_back(load(centreline_, section));
  record.smallest_gap = found_gap(gap_);
  record.penetration = found_penetration();
  return record;
}

SectionRecord Sections::look(const ConstVectors& position) const {
  seek(position);
  wait_for(ExecSpace());
  return found();
}

const SectionBoxes<ExecSpace>& Sections::locate(const ConstVectors& position) const {
  SKEIN_REQUIRE(position.extent_int(0) == n_nodes_, "positions are those of the fibers' nodes");
  locate_sections<ExecSpace>(ExecSpace(), *boxes_, position);
  return *boxes_;
}

const SectionBoxes<ExecSpace>& Sections::locate_at(const ConstVectors& centroid) const {
  SKEIN_REQUIRE(centroid.extent_int(0) == n_sections_, "a centroid for each section is needed");
  Kokkos::deep_copy(ExecSpace(), boxes_->centroid, centroid);
  enclose_sections<ExecSpace>(ExecSpace(), *boxes_);
  return *boxes_;
}

}  // namespace skein
