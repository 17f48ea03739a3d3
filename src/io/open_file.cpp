#include "open_file.hpp"

#include <skein/core/error.hpp>
#include <skein/io/atomic_file.hpp>
#include <skein/io/read_file.hpp>

#include "file_kind.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

namespace skein {
namespace {

constexpr int always = O_CREAT | O_NOFOLLOW | O_NONBLOCK | O_NOCTTY | O_CLOEXEC;
constexpr mode_t permissions = 0666;  // less the user's mask

[[noreturn]] void fail(const std::filesystem::path& path, const int error_number) {
  struct stat there {};
  const char* kind = ::lstat(path.c_str(), &there) == 0 ? name_of_kind(there.st_mode) : "";
  if (*kind != '\0')
    throw Error(
        ExitCode::cannot_create,
        fmt::format("'{}' is {}, and nothing is written through it: remove it and try again.", path.string(), kind));
  const bool full = error_number == ENOSPC || error_number == EDQUOT;
  throw Error(ExitCode::io_error, fmt::format("cannot open '{}' for writing (0 bytes written): {}.{}", path.string(),
                                              std::strerror(error_number), full ? " Make room and try again." : ""));
}

int open_regular(const std::filesystem::path& path, const int flags) {
  const int descriptor = ::open(path.c_str(), flags | always, permissions);
  if (descriptor < 0) fail(path, errno);
  struct stat opened {};
  if (::fstat(descriptor, &opened) == 0 && S_ISREG(opened.st_mode)) return descriptor;
  const int error_number = errno;
  ::close(descriptor);
  fail(path, error_number);
}

}  // namespace

int create_file(const std::filesystem::path& path) {
  constexpr int n_tries = 10;  // somebody may put something there again and again
  for (int i = 0; i < n_tries; ++i) {
    const int descriptor = ::open(path.c_str(), O_WRONLY | O_EXCL | always, permissions);
    if (descriptor >= 0) return descriptor;
    if (errno != EEXIST) break;
    if (::unlink(path.c_str()) != 0 && errno != ENOENT) break;
  }
  fail(path, errno);
}

int open_to_append(const std::filesystem::path& path) {
  const int descriptor = open_regular(path, O_WRONLY | O_APPEND);
  if (!has_other_names(descriptor)) return descriptor;
  ::close(descriptor);
  write_file_atomically(path, read_file(path));
  return open_regular(path, O_WRONLY | O_APPEND);
}

int open_to_lock(const std::filesystem::path& path) { return open_regular(path, O_RDWR); }

bool has_other_names(const int descriptor) {
  struct stat opened {};
  return ::fstat(descriptor, &opened) == 0 && opened.st_nlink > 1;
}

}  // namespace skein
