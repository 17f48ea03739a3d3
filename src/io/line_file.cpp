#include <skein/core/error.hpp>
#include <skein/io/line_file.hpp>

#include "open_file.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <string>

namespace skein {

LineFile::LineFile(const std::filesystem::path& path) : path_(path), descriptor_(open_to_append(path)) {}

LineFile::~LineFile() { ::close(descriptor_); }

void LineFile::write_line(const std::string_view line) {
  std::string whole(line);
  whole += '\n';
  const off_t before = ::lseek(descriptor_, 0, SEEK_END);
  std::size_t written = 0;
  while (written < whole.size()) {
    const ssize_t n = ::write(descriptor_, whole.data() + written, whole.size() - written);
    if (n < 0 && errno == EINTR) continue;
    if (n <= 0) {
      const int error_number = n < 0 ? errno : ENOSPC;
      // Half a line would spoil the next one. Where even this fails, the error below says enough.
      if (written > 0 && before >= 0) static_cast<void>(!::ftruncate(descriptor_, before));
      throw Error(ExitCode::io_error, fmt::format("cannot write {} bytes to '{}': {}.", whole.size(), path_.string(),
                                                  std::strerror(error_number)));
    }
    written += static_cast<std::size_t>(n);
  }
}

}  // namespace skein
