#pragma once

#include <skein/io/run_folder.hpp>
#include <skein/io/trajectory.hpp>
#include <skein/scene/scene_config.hpp>

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace skein {

/// The frames of a run as they were saved, one closed segment at a time: also of a run that is on its way.
///
/// @throws Error(missing_input) if there is no run folder, Error(damaged_data) naming the file that is damaged, is of
///         another run or, as a scene that was edited, no longer of this one, and its array that does not fit the
///         scene, the index or the other arrays, or holds what is no finite number; Error(io_error) if one cannot be
///         read
class TrajectoryReader {
 public:
  /// @param scene  that of the folder: it says which arrays a frame has
  TrajectoryReader(const RunFolder& folder, const SceneConfig& scene);

  std::int64_t n_frames() const { return first_frames_.back(); }

  /// Calls visit(frame) for every frame in the order of time. Positions that were saved in single precision come back
  /// with that precision; centreline and curvature are always double.
  void for_each_frame(const std::function<void(const Frame&)>& visit) const;

  /// @param number  below n_frames()
  Frame read_frame(std::int64_t number) const;

  /// Of all frames.
  std::vector<double> read_times() const;

 private:
  std::filesystem::path path_of(std::size_t segment) const;

  RunFolder folder_;
  OutputConfig output_;
  TrajectoryLayout layout_;
  std::vector<std::int64_t> first_frames_;  ///< [n_segments + 1]
  std::string chain_;                       ///< see RunSummary
};

}  // namespace skein
