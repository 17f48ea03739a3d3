#pragma once

#include <skein/fibers/fiber.hpp>
#include <skein/io/run_folder.hpp>
#include <skein/scene/scene_config.hpp>

#include "segment.hpp"

#include <cstdint>
#include <string>
#include <vector>

namespace skein {

/// The text of trajectory.xdmf: one surface mesh a frame, whose points lie in the segments and whose cells lie in the
/// index. It grows with the run.
///
/// Points are datasets of their own, one for each frame: of VTK's two readers the older one complains about hyperslabs
/// (and may show the first frame at all times), the newer one gives no points for them (both seen with ParaView 5.11).
class XdmfText {
 public:
  XdmfText(const std::vector<Fiber>& fibers, const OutputConfig& output);

  void add_frames(const Segment& segment, const std::vector<double>& times);

  /// One frame's part of the text.
  std::string describe_frame(std::int64_t segment, std::size_t row, double time) const;

  /// True where so much was added since the file was written that it pays to write it again. While a run goes on the
  /// file may thus lack up to a ninth of the frames on disk.
  bool has_grown() const;

  /// In place of the one before; nothing where no frame was added, and none while there is no frame, since readers
  /// refuse an empty collection. @returns the bytes written
  std::uint64_t write(const RunFolder& folder);

 private:
  std::string mesh_;  // what every frame says alike
  std::string frames_;
  std::size_t n_written_ = 0;  // bytes of frames_ that the file has
  int n_nodes_;
  int float_bytes_;
};

}  // namespace skein
