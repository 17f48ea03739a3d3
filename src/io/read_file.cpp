#include <skein/core/error.hpp>
#include <skein/io/read_file.hpp>

#include "file_kind.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <new>
#include <stdexcept>

namespace skein {
namespace {

[[noreturn]] void fail_to_read(const std::filesystem::path& path, const std::string& reason) {
  throw Error(ExitCode::io_error, fmt::format("cannot read '{}': {}.", path.string(), reason));
}

[[noreturn]] void fail_to_open(const std::filesystem::path& path, const int error_number) {
  const bool is_missing = error_number == ENOENT || error_number == ENOTDIR;
  throw Error(is_missing ? ExitCode::missing_input : ExitCode::io_error,
              fmt::format("cannot open '{}': {}.", path.string(), std::strerror(error_number)));
}

void check_kind(const std::filesystem::path& path, const mode_t mode) {
  if (S_ISREG(mode)) return;
  fail_to_read(path, fmt::format("it is {}, where a file should be", name_of_kind(mode)));
}

class ReadingDescriptor {
 public:
  // Opening a pipe does not wait for its writer this way.
  explicit ReadingDescriptor(const std::filesystem::path& path)
      : number_(::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK | O_NOCTTY)) {
    if (number_ < 0) fail_to_open(path, errno);
  }
  ~ReadingDescriptor() { ::close(number_); }
  ReadingDescriptor(const ReadingDescriptor&) = delete;
  ReadingDescriptor& operator=(const ReadingDescriptor&) = delete;

  int number() const { return number_; }

 private:
  int number_;
};

// The size that the system tells is a first guess: that of files in /proc is 0.
std::string read_all(const std::filesystem::path& path, const int descriptor, const std::size_t expected_size) {
  constexpr std::size_t growth = 64 << 10;
  std::string content(expected_size + 1, '\0');
  std::size_t n_read = 0;
  for (;;) {
    if (n_read == content.size()) content.resize(content.size() + growth);
    const ssize_t n = ::read(descriptor, content.data() + n_read, content.size() - n_read);
    if (n < 0 && errno == EINTR) continue;
    if (n < 0) fail_to_read(path, std::strerror(errno));
    if (n == 0) break;
    n_read += static_cast<std::size_t>(n);
  }
  content.resize(n_read);
  return content;
}

}  // namespace

std::string read_file(const std::filesystem::path& path) {
  const ReadingDescriptor descriptor(path);
  struct stat status {};
  if (::fstat(descriptor.number(), &status) != 0) fail_to_read(path, std::strerror(errno));
  check_kind(path, status.st_mode);
  const auto size = static_cast<std::size_t>(status.st_size);
  try {
    return read_all(path, descriptor.number(), size);
  } catch (const std::bad_alloc&) {
    fail_to_read(path, fmt::format("there is not enough memory for its {} bytes", size));
  } catch (const std::length_error&) {
    fail_to_read(path, fmt::format("there is not enough memory for its {} bytes", size));
  }
}

void check_is_file(const std::filesystem::path& path) {
  struct stat status {};
  if (::stat(path.c_str(), &status) != 0) fail_to_open(path, errno);
  check_kind(path, status.st_mode);
}

}  // namespace skein
