#include "xdmf.hpp"

#include <skein/io/atomic_file.hpp>

#include "surface_mesh.hpp"

#include <fmt/format.h>

#include <iterator>

namespace skein {
namespace {

constexpr const char* head =
    "<?xml version=\"1.0\" ?>\n"
    "<Xdmf Version=\"2.0\">\n"
    "<Domain>\n"
    "<Grid Name=\"fibers\" GridType=\"Collection\" CollectionType=\"Temporal\">\n";
constexpr const char* tail = "</Grid>\n</Domain>\n</Xdmf>\n";

std::string node_attribute(const char* name, const char* dataset, const int n_nodes) {
  return fmt::format(
      "<Attribute Name=\"{}\" AttributeType=\"Scalar\" Center=\"Node\">"
      "<DataItem Format=\"HDF\" NumberType=\"Int\" Precision=\"4\" Dimensions=\"{}\">trajectory.h5:{}</DataItem>"
      "</Attribute>\n",
      name, n_nodes, dataset);
}

}  // namespace

XdmfText::XdmfText(const std::vector<Fiber>& fibers, const OutputConfig& output)
    : n_nodes_(count_nodes(fibers)), float_bytes_(bytes_per_number(output.precision)) {
  const std::size_t n_quads = make_surface_mesh(fibers).size();
  mesh_ = fmt::format(
      "<Topology TopologyType=\"Quadrilateral\" NumberOfElements=\"{0}\">"
      "<DataItem Format=\"HDF\" NumberType=\"Int\" Precision=\"4\" Dimensions=\"{0} 4\">"
      "trajectory.h5:/connectivity/surface</DataItem></Topology>\n",
      n_quads);
  mesh_ += node_attribute("fiber", "/parameters/node_fiber", n_nodes_);
  mesh_ += node_attribute("section", "/parameters/node_section", n_nodes_);
}

void XdmfText::add_frames(const Segment& segment, const std::vector<double>& times) {
  for (std::size_t row = 0; row < times.size(); ++row)
    fmt::format_to(
        std::back_inserter(frames_),
        "<Grid Name=\"fibers\" GridType=\"Uniform\"><Time Value=\"{}\"/>\n{}"
        "<Geometry GeometryType=\"XYZ\">"
        "<DataItem Format=\"HDF\" NumberType=\"Float\" Precision=\"{}\" Dimensions=\"{} 3\">{}:/frames/{}</DataItem>"
        "</Geometry></Grid>\n",
        times[row], mesh_, float_bytes_, n_nodes_, segment_name(segment.number), row);
}

std::uint64_t XdmfText::write(const RunFolder& folder) const {
  if (frames_.empty()) return 0;
  AtomicFile file(folder.xdmf());
  file.write(head);
  file.write(frames_);
  file.write(tail);
  file.commit();
  return file.bytes_written();
}

}  // namespace skein
