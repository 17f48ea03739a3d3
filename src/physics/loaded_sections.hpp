#pragma once

#include <skein/arrays/types.hpp>
#include <skein/core/error.hpp>
#include <skein/fibers/fiber.hpp>

#include "device_list.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace skein {

/// A section on which something acts, and which entries of a list of loads do.
struct LoadedSection {
  int fiber = 0;
  int first_node = 0, n_nodes = 0;
  int first_load = 0, end_load = 0;

  /// The mean of a vector on the section's nodes, such as its centroid.
  KOKKOS_INLINE_FUNCTION Vec3 mean(const ConstVectors& vector) const {
    Vec3 sum;
    for (int node = first_node; node < first_node + n_nodes; ++node) sum = sum + load(vector, node);
    return sum / static_cast<double>(n_nodes);
  }
};

/// Loads on sections, grouped so that each section is the task of one thread, which takes its loads in the order of the
/// scene: no number is written by two threads.
template <class Load>
struct LoadedSections {
  Kokkos::View<LoadedSection*, ExecSpace> section;
  Kokkos::View<Load*, ExecSpace> load;          ///< by sections
  Kokkos::View<int*, Kokkos::HostSpace> fiber;  ///< of each section, for the host

  int n_sections() const { return section.extent_int(0); }
  int n_loads() const { return load.extent_int(0); }
};

/// Adds to every node of a section an equal part of a vector.
KOKKOS_INLINE_FUNCTION void add_to_nodes(const LoadedSection& section, const Vec3 sum, const Vectors& vectors) {
  const Vec3 part = sum / static_cast<double>(section.n_nodes);
  for (int node = section.first_node; node < section.first_node + section.n_nodes; ++node)
    store(vectors, node, load(vectors, node) + part);
}

/// sum [fiber of the section] += value, for each section. After a wait for the device.
template <class Load>
void add_by_fibers(const LoadedSections<Load>& loads, const FoundReals& of_section, std::vector<double>& sum) {
  for (int s = 0; s < loads.n_sections(); ++s) sum[static_cast<std::size_t>(loads.fiber(s))] += of_section(s);
}

/// For loads that turn sections. @param advice  the end of the message, after "points, which "
/// @throws Error(scene_error) where the fiber of one has sections of single nodes
template <class Config>
void refuse_lines(const char* what, const char* advice, const std::vector<Config>& configs,
                  const std::vector<Fiber>& fibers) {
  for (std::size_t i = 0; i < configs.size(); ++i) {
    const int fiber = configs[i].fiber;
    if (fiber < static_cast<int>(fibers.size()) && fibers[fiber].config.is_line())
      throw Error(ExitCode::scene_error,
                  fmt::format("{}[{}].fiber {}: sections of chains and rigid fibers are points, which {}", what, i,
                              fiber, advice));
  }
}

/// @param what     "tether": names an instance in messages, and the arrays
/// @param configs  each with a fiber and a section; a section below 0 counts from the end, -1 is the last
/// @param make     the load of a config
/// @throws Error(scene_error) where there is no such fiber or section
template <class Load, class Config, class Make>
LoadedSections<Load> make_loaded_sections(const std::string& what, const std::vector<Config>& configs,
                                          const std::vector<Fiber>& fibers, const Make& make) {
  std::map<std::pair<int, int>, std::vector<Load>> loads;
  for (std::size_t i = 0; i < configs.size(); ++i) {
    const Config& config = configs[i];
    if (config.fiber >= static_cast<int>(fibers.size()))
      throw Error(ExitCode::scene_error, fmt::format("{}[{}].fiber {}: the scene's fibers are 0 to {}", what, i,
                                                     config.fiber, static_cast<int>(fibers.size()) - 1));
    const int n_sections = fibers[config.fiber].config.sections;
    const int section = config.section < 0 ? config.section + n_sections : config.section;
    if (section < 0 || section >= n_sections)
      throw Error(ExitCode::scene_error, fmt::format("{}[{}].section {}: sections of fiber {} are {} to {}", what, i,
                                                     config.section, config.fiber, -n_sections, n_sections - 1));
    loads[{config.fiber, section}].push_back(make(config, fibers[config.fiber]));
  }
  std::vector<LoadedSection> sections;
  std::vector<Load> in_order;
  LoadedSections<Load> result;
  for (const auto& [place, list] : loads) {
    const Fiber& fiber = fibers[place.first];
    const int n = fiber.config.nodes_per_section, first = static_cast<int>(in_order.size());
    in_order.insert(in_order.end(), list.begin(), list.end());
    sections.push_back({place.first, fiber.first_node + place.second * n, n, first, static_cast<int>(in_order.size())});
  }
  result.section = copy_to_device(("skein::" + what + "::section").c_str(), sections);
  result.load = copy_to_device(("skein::" + what + "::load").c_str(), in_order);
  result.fiber = Kokkos::View<int*, Kokkos::HostSpace>("skein::" + what + "::fiber", sections.size());
  for (std::size_t s = 0; s < sections.size(); ++s) result.fiber(s) = sections[s].fiber;
  return result;
}

}  // namespace skein
