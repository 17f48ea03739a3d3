#include <skein/core/error.hpp>
#include <skein/core/milestone.hpp>
#include <skein/io/atomic_file.hpp>
#include <skein/io/start_name.hpp>

#include "open_file.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <string>
#include <utility>

namespace skein {
namespace {

[[noreturn]] void throw_io_error(const std::string& what, const int error_number) {
  const bool full = error_number == ENOSPC || error_number == EDQUOT || error_number == EFBIG;
  throw Error(ExitCode::io_error,
              fmt::format("{}: {}.{}", what, std::strerror(error_number),
                          full ? " Make room, then resume the run; what it wrote before is whole." : ""));
}

// A rename is on disk only when its folder is.
void sync_folder(const std::filesystem::path& folder, const std::string& what) {
  const int descriptor = ::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (descriptor < 0) throw_io_error(what + ": its folder cannot be opened", errno);
  // Some network file systems know no sync of folders; they rename in order.
  const int error_number = ::fsync(descriptor) == 0 ? 0 : errno;
  ::close(descriptor);
  if (error_number != 0 && error_number != EINVAL && error_number != ENOTSUP)
    throw_io_error(what + ": its folder cannot be synced", error_number);
}

// For tests: "checkpoint.half", "segment.before_rename", "start.half", "trajectory.h5.after_rename", ...
void reach_point(const std::filesystem::path& path, const char* point) {
  const std::string folder = path.parent_path().filename().string();
  const std::string name = path.filename().string();
  const std::string kind = folder == "checkpoints" ? "checkpoint"
                           : folder == "segments"  ? "segment"
                           : is_start_name(name)   ? "start"
                                                   : name;
  pass_milestone(kind + "." + point);
}

}  // namespace

AtomicFile::AtomicFile(std::filesystem::path path) : path_(std::move(path)), partial_(path_) {
  partial_ += ".partial";
  descriptor_ = create_file(partial_);
}

AtomicFile::~AtomicFile() {
  if (descriptor_ < 0) return;
  ::close(descriptor_);
  ::unlink(partial_.c_str());
}

void AtomicFile::write(const void* bytes, const std::size_t n_bytes) {
  const char* next = static_cast<const char*>(bytes);
  const std::size_t half = n_bytes / 2;  // in two parts, so that tests can kill between them
  std::size_t left = n_bytes;
  while (left > 0) {
    const ssize_t written = ::write(descriptor_, next, left > half ? left - half : left);
    if (written < 0 && errno == EINTR) continue;
    if (written <= 0)
      throw_io_error(
          fmt::format("cannot write {} bytes to '{}', only {} of them", n_bytes, path_.string(), n_bytes - left),
          written < 0 ? errno : ENOSPC);
    next += written;
    left -= static_cast<std::size_t>(written);
    if (left == half) reach_point(path_, "half");
  }
  bytes_written_ += n_bytes;
}

std::string AtomicFile::what_fails() const {
  return fmt::format("cannot put '{}' ({} bytes) on disk", path_.string(), bytes_written_);
}

void AtomicFile::sync() {
  if (::fsync(descriptor_) != 0) throw_io_error(what_fails(), errno);
}

void AtomicFile::commit() {
  const std::string what = what_fails();
  sync();
  reach_point(path_, "before_rename");
  const int descriptor = std::exchange(descriptor_, -1);
  if (::close(descriptor) != 0 || ::rename(partial_.c_str(), path_.c_str()) != 0) {
    const int error_number = errno;
    ::unlink(partial_.c_str());
    throw_io_error(what, error_number);
  }
  reach_point(path_, "after_rename");
  sync_folder(path_.has_parent_path() ? path_.parent_path() : ".", what);
}

void write_file_atomically(const std::filesystem::path& path, const std::string_view content) {
  AtomicFile file(path);
  file.write(content);
  file.commit();
}

}  // namespace skein
