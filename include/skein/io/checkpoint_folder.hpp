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

  /// In growing order.
  static std::vector<std::int64_t> list_numbers(const RunFolder& folder);
  static std::filesystem::path path_of(const RunFolder& folder, std::int64_t number);

 private:
  RunFolder folder_;
  std::int64_t last_number_ = 0;
};

/// Where a run can go on.
struct ResumePoint {
  std::optional<Checkpoint> checkpoint;  ///< none where no checkpoint was ever written: the run starts again
  std::filesystem::path path;
  std::vector<std::string> rejected;  ///< what is wrong with each newer one, newest first; its file was renamed
};

/// The newest checkpoint that is whole, belongs to the folder's scene, and whose frames are all there. Newer ones that
/// are not are renamed to `<name>.damaged`.
/// @throws Error(damaged_data), naming them all, if there are checkpoints and none is good
ResumePoint find_resume_point(const RunFolder& folder);

/// Why a checkpoint cannot serve a run folder; empty if it can.
std::string find_checkpoint_fault(const RunFolder& folder, const Checkpoint& checkpoint);

}  // namespace skein
