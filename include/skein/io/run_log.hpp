#pragma once

#include <skein/io/line_file.hpp>

#include <chrono>
#include <filesystem>
#include <string_view>

namespace skein {

/// run.log, for people: every line carries the wall time in seconds since the log was opened; the first says the date.
class RunLog {
 public:
  /// @throws Error(io_error), as write()
  explicit RunLog(const std::filesystem::path& path);

  /// A text of several lines becomes as many lines.
  void write(std::string_view text);

 private:
  LineFile file_;
  std::chrono::steady_clock::time_point start_;
};

}  // namespace skein
