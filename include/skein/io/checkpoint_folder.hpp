#pragma once

#include <skein/io/checkpoint.hpp>
#include <skein/io/run_folder.hpp>

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace skein {

/// The numbered checkpoints of a run: checkpoints/000012.checkpoint.
class CheckpointFolder {
 public:
  /// Makes the folder where it is not there. @throws Error(io_error)
  explicit CheckpointFolder(const RunFolder& folder);

  /// Puts a checkpoint on disk under the next number, and then removes all but the newest `keep`.
  /// @returns the bytes written. @throws Error(io_error): the older ones are then all there still.
  std::uint64_t write(const Checkpoint& checkpoint, int keep);

  /// Puts as much on disk as write() does, and removes it: how long that takes is what the caller wants to know.
  void rehearse(const Checkpoint& checkpoint) const;

  std::int64_t last_number() const { return last_number_; }
  std::filesystem::path path_of(std::int64_t number) const;

  /// In growing order. @throws Error(io_error) if the folder cannot be listed; none where there is no folder
  static std::vector<std::int64_t> list_numbers(const RunFolder& folder);
  static std::filesystem::path path_of(const RunFolder& folder, std::int64_t number);

 private:
  RunFolder folder_;
  std::int64_t last_number_ = 0;
};

/// Where a run can go on.
struct ResumePoint {
  std::optional<Checkpoint> checkpoint;  ///< none: the run starts at its beginning
  std::filesystem::path path;
  std::vector<std::string> rejected;  ///< what is wrong with each newer one, newest first, and what became of its file
};

/// The newest checkpoint that can be read, is whole, belongs to the folder's scene, and whose frames are all there.
/// Newer ones that are not are renamed to `<name>.damaged`.
///
/// Without a good one a run starts at its beginning only if it has no frames, or if they may be dropped.
/// @param from_start  drop the frames of a run that no checkpoint goes on from
/// @throws Error(damaged_data) if there is no good one but frames or other checkpoints, naming them all, or if the
/// scene
///         was changed; Error(io_error) instead where one could not be read, or a folder not be listed: nothing is lost
///         then; Error(usage) if there is a good one and from_start
ResumePoint find_resume_point(const RunFolder& folder, bool from_start);

/// The same point, for readers: nothing is renamed, and there is none where no checkpoint can be found.
/// @throws as find_resume_point
ResumePoint look_for_resume_point(const RunFolder& folder);

/// @throws Error(damaged_data), Error(io_error) saying why a checkpoint cannot serve a run folder
void check_checkpoint(const RunFolder& folder, const Checkpoint& checkpoint);

}  // namespace skein
