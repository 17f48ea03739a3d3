#include "trajectory_index.hpp"

#include <skein/core/version.hpp>

#include "segment_list.hpp"
#include "surface_mesh.hpp"

#include <pwd.h>
#include <unistd.h>

namespace skein {
namespace {

std::string login_name() {
  const passwd* user = ::getpwuid(::geteuid());
  return user != nullptr && user->pw_name != nullptr ? user->pw_name : "skein user";
}

void write_h5md_group(Hdf5Writer& file) {
  file.make_group("/h5md");
  file.set_attribute("/h5md", "version", std::vector<std::int64_t>{1, 1});
  file.make_group("/h5md/author");
  file.set_attribute("/h5md/author", "name", login_name());
  file.make_group("/h5md/creator");
  file.set_attribute("/h5md/creator", "name", std::string("skein"));
  file.set_attribute("/h5md/creator", "version", std::string(version()));
}

void write_connectivity(Hdf5Writer& file, const TrajectoryLayout& layout) {
  const auto surface = make_surface_mesh(layout.fibers);
  file.write("/connectivity/surface", Number::int32, {surface.size(), 4}, surface.data());
  file.set_reference("/connectivity/surface", "particles_group", "/particles/fibers");
}

void write_fibers(Hdf5Writer& file, const TrajectoryLayout& layout) {
  std::vector<std::int32_t> sections, nodes_per_section, first_node, first_section, node_fiber, node_section;
  std::vector<double> radius;
  for (std::size_t f = 0; f < layout.fibers.size(); ++f) {
    const Fiber& fiber = layout.fibers[f];
    sections.push_back(fiber.config.sections);
    nodes_per_section.push_back(fiber.config.nodes_per_section);
    first_node.push_back(fiber.first_node);
    first_section.push_back(fiber.first_section);
    radius.push_back(fiber.config.radius);
    for (int node = 0; node < fiber.n_nodes(); ++node) {
      node_fiber.push_back(static_cast<std::int32_t>(f));
      node_section.push_back(node / fiber.config.nodes_per_section);
    }
  }
  const auto write = [&file](const char* name, const std::vector<std::int32_t>& values) {
    file.write(name, Number::int32, {values.size()}, values.data());
  };
  write("/parameters/fiber_sections", sections);
  write("/parameters/fiber_nodes_per_section", nodes_per_section);
  write("/parameters/first_node", first_node);
  write("/parameters/first_section", first_section);
  write("/parameters/node_fiber", node_fiber);
  write("/parameters/node_section", node_section);
  file.write("/parameters/fiber_radius", Number::float64, {radius.size()}, radius.data(), "length");
  file.write("/parameters/blob", Number::float64, {layout.blobs.size()}, layout.blobs.data(), "length");
}

void write_parameters(Hdf5Writer& file, const TrajectoryLayout& layout, const std::string& status) {
  for (const auto& [name, text] : layout.attributes) file.set_attribute("/parameters", name, text);
  file.set_attribute("/parameters", "status", status);
  for (const auto& [name, quantity] : layout.parameters) {
    if (const double* number = std::get_if<double>(&quantity.value)) {
      file.write("/parameters/" + name, Number::float64, {}, number, quantity.unit);
    } else {
      const auto& list = std::get<std::vector<double>>(quantity.value);
      file.write("/parameters/" + name, Number::float64, {list.size()}, list.data(), quantity.unit);
    }
  }
}

}  // namespace

std::uint64_t write_trajectory_index(const RunFolder& folder, const TrajectoryLayout& layout, const Series& frames,
                                     const Series& records, const std::vector<Segment>& segments,
                                     const std::string& status) {
  std::vector<Hdf5Writer::Source> frame_sources, record_sources;
  for (const Segment& segment : segments) {
    const std::string name = segment_name(segment.number);
    frame_sources.push_back({name, static_cast<hsize_t>(segment.n_frames)});
    record_sources.push_back({name, static_cast<hsize_t>(segment.n_records)});
  }
  constexpr std::size_t growth = 1 << 20;
  Hdf5Writer file(folder.index(), growth);
  write_h5md_group(file);
  file.make_group("/particles/fibers/box");
  file.set_attribute("/particles/fibers/box", "dimension", 3);
  file.set_attribute("/particles/fibers/box", "boundary", std::vector<std::string>(3, "none"));
  frames.write_virtual(file, frame_sources);
  records.write_virtual(file, record_sources);
  write_connectivity(file, layout);
  write_fibers(file, layout);
  write_parameters(file, layout, status);
  write_segment_list(file, segments);
  return file.commit();
}

}  // namespace skein
