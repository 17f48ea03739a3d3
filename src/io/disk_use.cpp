#include <skein/io/disk_use.hpp>

#include "series.hpp"
#include "surface_mesh.hpp"
#include "xdmf.hpp"

namespace skein {
namespace {

// What HDF5 1.10.8 adds for objects, names and views, measured on runs of 1 to 1001 frames in 1 to 40 segments.
constexpr double bytes_of_view = 490.0;            // /frames/<n>, one for each frame
constexpr double bytes_of_segment = 36.7e3;        // without arrays
constexpr double bytes_of_index = 47e3;            // without arrays
constexpr double index_bytes_of_segment = 2.27e3;  // for its rows in each virtual dataset

double bytes_of_row(const Series& series) {
  double bytes = sizeof(std::int64_t) + sizeof(double);  // its moment
  for (const Series::Element& element : series.elements()) {
    double n = 1.0;
    for (const hsize_t extent : element.row_shape) n *= static_cast<double>(extent);
    bytes += n * static_cast<double>(size_of(element.number));
  }
  return bytes;
}

double index_bytes_of_fibers(const std::vector<Fiber>& fibers) {
  constexpr double bytes_of_node = 4 + 4 + 8;         // its fiber, its section, its blob
  constexpr double bytes_of_fiber = 4 * 4 + 5 * 8.0;  // integers and reals of /parameters
  return bytes_of_node * count_nodes(fibers) + 16.0 * static_cast<double>(count_surface_quads(fibers)) +
         bytes_of_fiber * static_cast<double>(fibers.size());
}

}  // namespace

DiskUse expect_trajectory_size(const std::vector<Fiber>& fibers, const OutputConfig& output,
                               const std::size_t scene_bytes, const TrajectoryCounts& counts) {
  TrajectoryLayout layout;
  layout.fibers = fibers;
  constexpr double typical_time = 1.0 / 3.0;  // as many digits as any
  const double text = static_cast<double>(XdmfText(fibers, output).describe_frame(0, 1000, typical_time).size());
  DiskUse use;
  use.frames = counts.frames * (bytes_of_row(make_frame_series(layout, output)) + bytes_of_view + text);
  use.records = counts.records * bytes_of_row(make_step_series(layout));
  use.rest = bytes_of_index + index_bytes_of_fibers(fibers) + static_cast<double>(scene_bytes) +
             counts.segments * (bytes_of_segment + index_bytes_of_segment);
  return use;
}

}  // namespace skein
