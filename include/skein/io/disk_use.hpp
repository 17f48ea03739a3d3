#pragma once

#include <skein/fibers/fiber.hpp>
#include <skein/scene/scene_config.hpp>

#include <cstddef>
#include <vector>

namespace skein {

/// How much a trajectory holds when it is finished. Counts are expectations, and need not be whole.
struct TrajectoryCounts {
  double frames = 0.0, records = 0.0, segments = 1.0;
};

/// Bytes on disk.
struct DiskUse {
  double frames = 0.0;   ///< in segments and in trajectory.xdmf
  double records = 0.0;  ///< of steps, in segments
  double rest = 0.0;     ///< the index, and what HDF5 adds to each segment

  double all() const { return frames + records + rest; }
};

/// What the files of a trajectory will take, to some per cent: TrajectoryWriter's own files, measured or counted.
/// @param scene_bytes  of the scene's text, which the index holds
DiskUse expect_trajectory_size(const std::vector<Fiber>& fibers, const OutputConfig& output, std::size_t scene_bytes,
                               const TrajectoryCounts& counts);

}  // namespace skein
