#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <utility>

namespace skein {

/// Where each file of a run lies. A run writes nothing outside its folder.
class RunFolder {
 public:
  using Use = std::function<void(const RunFolder&)>;

  /// Makes the folder with its parents, and puts the scene into it. What a run has left there that was killed before
  /// its scene was there is taken over. Nothing is removed before the new scene is written.
  ///
  /// @param scene      text of the resolved scene
  /// @param overwrite  clear what an earlier run left there, its tables and pictures included (and nothing else),
  ///                   instead of refusing
  /// @param use        called when the folder is there and before anything in it is written or removed: to lock it
  /// @param start      bytes of the state of another run that the scene begins with (io/start_file), which are there
  ///                   before the scene is; empty: there are none
  /// @throws Error(cannot_create) if the folder cannot be made, if it holds a run and overwrite is false, or if it
  /// holds
  ///         anything but a run; Error(io_error) if the disk is full or fails; what `use` throws.
  static RunFolder create(const std::filesystem::path& path, const std::string& scene, bool overwrite,
                          const Use& use = {}, const std::string& start = {});

  /// The folder of an earlier run. @throws Error(missing_input) if there is none.
  static RunFolder open(const std::filesystem::path& path);

  /// The folder of a run that may not have come as far as its first index. @throws Error(missing_input) if there is
  /// none, or no scene in it.
  static RunFolder open_begun(const std::filesystem::path& path);

  const std::filesystem::path& path() const { return path_; }
  std::filesystem::path scene() const { return path_ / "scene.toml"; }
  std::filesystem::path index() const { return path_ / "trajectory.h5"; }
  std::filesystem::path xdmf() const { return path_ / "trajectory.xdmf"; }
  std::filesystem::path segments() const { return path_ / "segments"; }
  std::filesystem::path checkpoints() const { return path_ / "checkpoints"; }
  std::filesystem::path run_log() const { return path_ / "run.log"; }
  std::filesystem::path lock() const { return path_ / "lock"; }
  std::filesystem::path stop_request() const { return path_ / "STOP"; }
  std::filesystem::path output_request() const { return path_ / "OUTPUT_NOW"; }
  std::filesystem::path analysis() const { return path_ / "analysis"; }
  std::filesystem::path plots() const { return path_ / "plots"; }
  std::filesystem::path events() const { return path_ / "events.jsonl"; }

  /// True if a path is, or leads to, a file that the run itself reads or writes, or would be taken for one: whatever
  /// its spelling, and whether or not it is there.
  bool is_part(const std::filesystem::path& path) const;

 private:
  explicit RunFolder(std::filesystem::path path) : path_(std::move(path)) {}

  std::filesystem::path path_;
};

/// For whatever is written about a run. @throws Error(cannot_create) if the output, a file or a folder, is a part of it
void check_output(const std::filesystem::path& output, const RunFolder& run);

}  // namespace skein
