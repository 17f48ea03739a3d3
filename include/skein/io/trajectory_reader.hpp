#pragma once

#include <skein/io/run_folder.hpp>
#include <skein/io/trajectory.hpp>

#include <cstdint>
#include <functional>

namespace skein {

/// The frames of a run as they were saved, one closed segment at a time: also of a run that is on its way.
///
/// @throws Error(missing_input) if there is no run folder, Error(damaged_data) naming the file that is unreadable
class TrajectoryReader {
 public:
  explicit TrajectoryReader(const RunFolder& folder);

  std::int64_t n_frames() const { return n_frames_; }

  /// Calls visit(frame) for every frame in the order of time. Positions that were saved in single precision come back
  /// with that precision; centreline and curvature are always double.
  void for_each_frame(const std::function<void(const Frame&)>& visit) const;

 private:
  RunFolder folder_;
  std::int64_t n_segments_ = 0, n_frames_ = 0;
};

}  // namespace skein
