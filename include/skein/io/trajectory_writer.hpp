#pragma once

#include <skein/io/run_folder.hpp>
#include <skein/io/trajectory.hpp>
#include <skein/io/trajectory_end.hpp>
#include <skein/scene/scene_config.hpp>

#include <cstdint>
#include <memory>
#include <string>

namespace skein {

/// When buffered frames and step records become a segment on disk without being asked for.
struct SegmentLimits {
  std::uint64_t bytes = std::uint64_t{64} << 20;
  double seconds = 30.0;        ///< wall time since the last one
  double largest_share = 0.02;  ///< of the wall time may go into segments that nobody asked for: the time above grows
};

/// Writes the trajectory of a run: closed segments, the index trajectory.h5 over them, and trajectory.xdmf.
///
/// Every file appears whole under its name or not at all, the index after its segment: whoever reads while the run
/// writes sees complete frames only, and a killed program loses what was buffered, nothing else.
/// Layout of the files: H5MD 1.1, see src/io/trajectory_index.hpp and src/io/segment.hpp.
///
/// @throws Error(io_error), naming file and bytes, from every function that writes; what was buffered is kept then, so
///         that close_segment() may be tried again.
class TrajectoryWriter {
 public:
  /// Writes an index without frames, so that the folder can be read from now on.
  TrajectoryWriter(const RunFolder& folder, TrajectoryLayout layout, const OutputConfig& output,
                   SegmentLimits limits = {});

  /// Goes on with a trajectory after `end`. Nothing in the folder is changed before begin(), so that whatever else a
  /// run needs can fail in between. @throws Error(damaged_data), Error(io_error) if what lies before `end` is not whole
  TrajectoryWriter(const RunFolder& folder, TrajectoryLayout layout, const OutputConfig& output,
                   const TrajectoryEnd& end, SegmentLimits limits = {});

  /// Makes the folder's trajectory end where this one goes on: writes the index, and removes what lies behind.
  void begin();

  /// Tries to save what is still buffered, but cannot report a failure: call finish() first.
  ~TrajectoryWriter();
  TrajectoryWriter(const TrajectoryWriter&) = delete;
  TrajectoryWriter& operator=(const TrajectoryWriter&) = delete;

  /// Times must grow from one frame, or record, to the next. @throws Error(internal) if not, or if a shape is wrong
  void append(const Frame& frame);
  void append(const StepRecord& record);

  /// Puts what is buffered on disk; nothing happens where nothing is.
  void close_segment();

  /// What is on disk: after close_segment() all that was appended.
  TrajectoryEnd end() const;

  /// close_segment(), and writes how the run ended into the index: "done", "stopped", ... Until then it says "running".
  void finish(const std::string& status);

  std::uint64_t bytes_written() const;  ///< all files together, rewritten ones each time
  double seconds_spent() const;         ///< wall time inside this class

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace skein
