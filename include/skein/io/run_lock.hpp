#pragma once

#include <skein/io/run_folder.hpp>

#include <filesystem>
#include <string>

namespace skein {

/// Keeps a second writer out of a folder while this object lives: a file in it, of a run's folder `lock`, locked by the
/// system and holding host name, process and when that process began. The lock of a process that is no more is taken
/// over.
class RunLock {
 public:
  /// @throws Error(cannot_create), saying who holds it, if the folder has a writer, or had one on another host and
  ///         whether that lives cannot be known: where the file system may be shared with other machines.
  /// @throws Error(io_error) if the lock cannot be written.
  explicit RunLock(const RunFolder& folder) : RunLock(folder.lock()) {}
  /// @param lock_file  in a folder that is there
  explicit RunLock(std::filesystem::path lock_file);
  ~RunLock();
  RunLock(const RunLock&) = delete;
  RunLock& operator=(const RunLock&) = delete;

  bool was_left_behind() const { return was_left_behind_; }  ///< by a process that did not end by itself
  const std::string& note() const { return note_; }  ///< to be said: that another host's was taken over; or empty

 private:
  std::filesystem::path path_;
  int descriptor_ = -1;
  bool was_left_behind_ = false;
  std::string note_;
};

}  // namespace skein
