#include "xdmf.hpp"

#include <skein/io/atomic_file.hpp>

#include "surface_mesh.hpp"

#include <fmt/format.h>

namespace skein {
namespace {

// The mesh is an entity of the document, which every frame refers to: three quarters of the text would repeat it. Of
// the ways to refer that XDMF knows only this one is understood by both of VTK's readers, whose parser sees plain
// elements.
constexpr const char* head =
    "<?xml version=\"1.0\" ?>\n"
    "<!DOCTYPE Xdmf [<!ENTITY mesh '{}'>]>\n"
    "<Xdmf Version=\"2.0\">\n"
    "<Domain>\n"
    "<Grid Name=\"fibers\" GridType=\"Collection\" CollectionType=\"Temporal\">\n";
constexpr const char* tail = "</Grid>\n</Domain>\n</Xdmf>\n";

/// A file is not written again before it has grown by this share: what is written in all stays below ten times the
/// last.
constexpr double share_of_growth = 0.125;

std::string node_attribute(const char* name, const char* dataset, const int n_nodes) {
  return fmt::format(
      "<Attribute Name=\"{}\" AttributeType=\"Scalar\" Center=\"Node\">"
      "<DataItem Format=\"HDF\" NumberType=\"Int\" Precision=\"4\" Dimensions=\"{}\">trajectory.h5:{}</DataItem>"
      "</Attribute>",
      name, n_nodes, dataset);
}

}  // namespace

XdmfText::XdmfText(const std::vector<Fiber>& fibers, const OutputConfig& output)
    : n_nodes_(count_nodes(fibers)), float_bytes_(bytes_per_number(output.precision)) {
  mesh_ = fmt::format(
      "<Topology TopologyType=\"Quadrilateral\" NumberOfElements=\"{0}\">"
      "<DataItem Format=\"HDF\" NumberType=\"Int\" Precision=\"4\" Dimensions=\"{0} 4\">"
      "trajectory.h5:/connectivity/surface</DataItem></Topology>",
      count_surface_quads(fibers));
  mesh_ += node_attribute("fiber", "/parameters/node_fiber", n_nodes_);
  mesh_ += node_attribute("section", "/parameters/node_section", n_nodes_);
}

std::string XdmfText::describe_frame(const std::int64_t segment, const std::size_t row, const double time) const {
  return fmt::format(
      "<Grid Name=\"fibers\"><Time Value=\"{}\"/>&mesh;<Geometry GeometryType=\"XYZ\">"
      "<DataItem Format=\"HDF\" NumberType=\"Float\" Precision=\"{}\" Dimensions=\"{} 3\">{}:/frames/{}</DataItem>"
      "</Geometry></Grid>\n",
      time, float_bytes_, n_nodes_, segment_name(segment), row);
}

void XdmfText::add_frames(const Segment& segment, const std::vector<double>& times) {
  for (std::size_t row = 0; row < times.size(); ++row) frames_ += describe_frame(segment.number, row, times[row]);
}

bool XdmfText::has_grown() const {
  return static_cast<double>(frames_.size()) > (1.0 + share_of_growth) * static_cast<double>(n_written_);
}

std::uint64_t XdmfText::write(const RunFolder& folder) {
  if (frames_.size() == n_written_) return 0;
  AtomicFile file(folder.xdmf());
  file.write(fmt::format(head, mesh_));
  file.write(frames_);
  file.write(tail);
  file.commit();
  n_written_ = frames_.size();
  return file.bytes_written();
}

}  // namespace skein
