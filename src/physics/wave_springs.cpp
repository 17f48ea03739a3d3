#include "wave_springs.hpp"

#include <skein/fibers/helix.hpp>
#include <skein/fibers/spring_network.hpp>
#include <skein/scene/profile.hpp>

#include "device_list.hpp"

#include <cmath>
#include <numbers>

namespace skein {
namespace {

/// Lists on the host, to be copied.
struct WaveLists {
  std::vector<WavingFiber> fiber;
  std::vector<int> fiber_of_node;
  std::vector<Gap> gap;
  std::vector<Wave> wave;
  std::vector<double> envelope, section_factor, stiffness, rest_length;
  std::vector<Vec3> place;
};

void append_wave(const UndulationConfig& config, const Fiber& fiber, WaveLists& lists) {
  const double to_radians = std::numbers::pi / 180.0;
  lists.wave.push_back({.curvature_towards_first = config.curvature * std::cos(to_radians * config.plane),
                        .curvature_across = config.curvature * std::sin(to_radians * config.plane),
                        .wave_number = config.wavelength > 0.0 ? 2.0 * std::numbers::pi / config.wavelength : 0.0,
                        .angular_frequency = config.angular_frequency,
                        .phase = to_radians * config.phase,
                        .ramp = config.ramp,
                        .first_envelope = static_cast<int>(lists.envelope.size())});
  for (int section = 0; section < fiber.config.sections; ++section)
    lists.envelope.push_back(interpolate(config.envelope, section / (fiber.config.sections - 1.0)));
}

void append_fiber(const Fiber& fiber, const std::vector<UndulationConfig>& undulations, WaveLists& lists) {
  const SpringNetwork network = make_spring_network(fiber);
  const SpringStencil& stencil = network.stencil;
  const int index = static_cast<int>(lists.fiber.size()), first_wave = static_cast<int>(lists.wave.size());
  for (const UndulationConfig& undulation : undulations)
    if (undulation.fiber == fiber.index) append_wave(undulation, fiber, lists);
  const bool is_straight = static_cast<int>(lists.wave.size()) == first_wave && !fiber.config.is_helix();
  lists.fiber_of_node.insert(lists.fiber_of_node.end(), fiber.n_nodes(), is_straight ? -1 : index);
  if (is_straight) return;
  lists.fiber.push_back({.first_node = fiber.first_node,
                         .n_sections = network.n_sections,
                         .nodes_per_section = stencil.nodes_per_section,
                         .reach = stencil.reach,
                         .first_entry = static_cast<int>(lists.stiffness.size()),
                         .first_section = static_cast<int>(lists.section_factor.size()),
                         .first_gap = static_cast<int>(lists.gap.size()),
                         .first_wave = first_wave,
                         .end_wave = static_cast<int>(lists.wave.size()),
                         .first_place = static_cast<int>(lists.place.size()),
                         .spacing = fiber.spacing()});
  const std::vector<SectionPose> rest = fiber.config.is_helix() ? make_helix(fiber) : std::vector<SectionPose>{};
  for (int section = 0; section < network.n_sections; ++section) {
    lists.section_factor.push_back(network.factor(section, 0));
    // Gaps beyond the end are there, so that all sections have as many, and have no length.
    for (int offset = 1; offset <= stencil.reach; ++offset) {
      Gap gap{index, section, section + offset < network.n_sections ? offset : 0, 0.0, 0.0};
      if (fiber.config.is_helix() && gap.offset > 0) {
        const RestBend bend = measure_rest_bend(rest[section], rest[section + offset], offset * fiber.spacing());
        gap.rest_first = bend.towards_0;
        gap.rest_across = bend.towards_90;
      }
      lists.gap.push_back(gap);
    }
  }
  for (int node = 0; node < stencil.nodes_per_section; ++node) {
    const double angle = 2.0 * std::numbers::pi * node / stencil.nodes_per_section;
    lists.place.push_back(fiber.config.radius * Vec3{std::cos(angle), std::sin(angle), 0.0});
  }
  for (std::size_t entry = 0; entry < stencil.stiffness.size(); ++entry) {
    const bool is_spring = stencil.stiffness[entry] > 0.0;
    lists.stiffness.push_back(is_spring ? stencil.stiffness[entry] : 0.0);
    lists.rest_length.push_back(is_spring ? stencil.rest_length[entry] : 1.0);
  }
}

}  // namespace

WaveArrays make_wave_arrays(const std::vector<UndulationConfig>& undulations, const std::vector<Fiber>& fibers) {
  WaveLists lists;
  for (const Fiber& fiber : fibers) append_fiber(fiber, undulations, lists);
  WaveArrays waves;
  waves.fiber = copy_to_device("skein::waving_fibers", lists.fiber);
  waves.fiber_of_node = copy_to_device("skein::waving_fiber_of_node", lists.fiber_of_node);
  waves.gap = copy_to_device("skein::wave_gaps", lists.gap);
  waves.wave = copy_to_device("skein::waves", lists.wave);
  waves.curvature = Kokkos::View<Curvature*, ExecSpace>("skein::wave_curvature", lists.gap.size());
  waves.place = to_device("skein::wave_places", lists.place);
  waves.envelope = to_device("skein::wave_envelope", lists.envelope);
  waves.section_factor = to_device("skein::wave_section_factor", lists.section_factor);
  waves.stiffness = to_device("skein::wave_stiffness", lists.stiffness);
  waves.rest_length = to_device("skein::wave_rest_length", lists.rest_length);
  return waves;
}

}  // namespace skein
