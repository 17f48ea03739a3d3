#include <skein/core/error.hpp>
#include <skein/io/read_file.hpp>
#include <skein/io/run_lock.hpp>

#include "local_file_system.hpp"
#include "open_file.hpp"

#include <fmt/format.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstdint>
#include <cstring>
#include <sstream>
#include <string>
#include <utility>

namespace skein {
namespace {

struct Owner {
  std::string host;
  std::int64_t process = 0;
  std::string began;  ///< as the kernel counts it, with the identity of the boot
};

std::string host_name() {
  std::array<char, 256> name{};
  return ::gethostname(name.data(), name.size() - 1) == 0 ? name.data() : "unknown";
}

std::string read_or_nothing(const std::string& path) {
  try {
    return read_file(path);
  } catch (const Error&) {
    return "";
  }
}

// Field 22 of /proc/<process>/stat counts clock ticks since the boot; the fields begin after the name in parentheses.
std::string find_beginning(const std::int64_t process) {
  const std::string stat = read_or_nothing(fmt::format("/proc/{}/stat", process));
  const auto end_of_name = stat.rfind(')');
  if (end_of_name == std::string::npos) return "";
  std::istringstream fields(stat.substr(end_of_name + 1));
  std::string field;
  for (int i = 3; i <= 22; ++i) fields >> field;
  std::istringstream boot(read_or_nothing("/proc/sys/kernel/random/boot_id"));
  std::string boot_id;
  boot >> boot_id;
  return field + "@" + boot_id;
}

std::string describe(const Owner& owner) {
  return fmt::format("host {}\nprocess {}\nbegan {}\n", owner.host, owner.process, owner.began);
}

Owner read_owner(const std::string& text) {
  Owner owner;
  std::istringstream words(text);
  std::string word;
  while (words >> word) {
    if (word == "host") words >> owner.host;
    if (word == "process") words >> owner.process;
    if (word == "began") words >> owner.began;
  }
  return owner;
}

[[noreturn]] void refuse_while_written(const std::filesystem::path& path, const Owner& owner) {
  const bool is_here = owner.host == host_name() || owner.host.empty();
  throw Error(
      ExitCode::cannot_create,
      fmt::format("'{}' is being written by process {}{}; wait for it, or stop it with a signal or a file named "
                  "STOP in the folder.",
                  path.parent_path().string(), owner.process, is_here ? "" : " on host " + owner.host));
}

[[noreturn]] void refuse_in_doubt(const std::filesystem::path& path, const Owner& owner) {
  throw Error(ExitCode::cannot_create,
              fmt::format("'{}' was locked by process {} on host {}, and whether that still runs cannot be seen from "
                          "here. If it does not, remove '{}' and try again.",
                          path.parent_path().string(), owner.process, owner.host, path.string()));
}

[[noreturn]] void fail(const std::filesystem::path& path, const char* what, const std::size_t n_bytes) {
  throw Error(ExitCode::io_error,
              fmt::format("cannot {} '{}' ({} bytes): {}.", what, path.string(), n_bytes, std::strerror(errno)));
}

std::string read_all(const int descriptor) {
  std::array<char, 1024> text{};
  const ssize_t n = ::pread(descriptor, text.data(), text.size(), 0);
  return {text.data(), static_cast<std::size_t>(n > 0 ? n : 0)};
}

// The file may have been removed by its last owner between our opening and locking it.
bool is_still_named(const int descriptor, const std::filesystem::path& path) {
  struct stat opened {
  }, named{};
  return ::fstat(descriptor, &opened) == 0 && ::lstat(path.c_str(), &named) == 0 && opened.st_ino == named.st_ino &&
         opened.st_dev == named.st_dev;
}

struct LockFile {
  int descriptor;
  bool is_held;  ///< by this process, as the system says; false where the file system has no locks
};

LockFile open_locked(const std::filesystem::path& path) {
  for (;;) {
    const int descriptor = open_to_lock(path);
    const bool is_held = ::flock(descriptor, LOCK_EX | LOCK_NB) == 0;
    if (!is_held && errno == EWOULDBLOCK) {
      const Owner owner = read_owner(read_all(descriptor));
      ::close(descriptor);
      refuse_while_written(path, owner);
    }
    if (is_still_named(descriptor, path)) return {descriptor, is_held};
    ::close(descriptor);
  }
}

bool lives_here(const Owner& owner) {
  return owner.process != ::getpid() && !owner.began.empty() && find_beginning(owner.process) == owner.began;
}

// Of an owner whose lock the system does not hold any more. What runs on another machine cannot have a file of this
// machine's own file systems; what calls itself by another name here, as in a container, would hold it.
void refuse_if_it_may_live(const std::filesystem::path& path, const Owner& owner, const LockFile& file) {
  if (owner.host == host_name()) {
    if (lives_here(owner)) refuse_while_written(path, owner);
  } else if (!file.is_held || !is_on_local_file_system(file.descriptor)) {
    refuse_in_doubt(path, owner);
  }
}

}  // namespace

RunLock::RunLock(std::filesystem::path lock_file) : path_(std::move(lock_file)) {
  LockFile file = open_locked(path_);
  const Owner before = read_owner(read_all(file.descriptor));
  was_left_behind_ = before.process > 0;
  try {
    if (was_left_behind_) refuse_if_it_may_live(path_, before, file);
  } catch (const Error&) {
    ::close(file.descriptor);
    throw;
  }
  if (was_left_behind_ && before.host != host_name())
    note_ = fmt::format("'{}' was left by process {} on host {}; nobody holds it on this file system: it is taken over",
                        path_.string(), before.process, before.host);
  if (has_other_names(file.descriptor)) {  // what is written here must not be seen elsewhere
    ::unlink(path_.c_str());
    ::close(file.descriptor);
    file = open_locked(path_);
  }
  const std::string text = describe({host_name(), ::getpid(), find_beginning(::getpid())});
  errno = ENOSPC;  // what a write that stops short means
  if (::ftruncate(file.descriptor, 0) != 0 ||
      ::pwrite(file.descriptor, text.data(), text.size(), 0) != static_cast<ssize_t>(text.size())) {
    const int error_number = errno;
    ::unlink(path_.c_str());
    ::close(file.descriptor);
    errno = error_number;
    fail(path_, "write", text.size());
  }
  descriptor_ = file.descriptor;
}

RunLock::~RunLock() {
  if (is_still_named(descriptor_, path_)) ::unlink(path_.c_str());
  ::close(descriptor_);
}

}  // namespace skein
