#pragma once

#include <filesystem>
#include <string_view>

namespace skein {

/// A text file that only grows, whole lines at a time; continued where it exists.
class LineFile {
 public:
  /// @throws Error(io_error) if it cannot be opened
  explicit LineFile(const std::filesystem::path& path);
  ~LineFile();
  LineFile(const LineFile&) = delete;
  LineFile& operator=(const LineFile&) = delete;

  /// Passes the line, and its end, to the system at once. @throws Error(io_error) naming the file and the bytes
  void write_line(std::string_view line);

 private:
  std::filesystem::path path_;
  int descriptor_ = -1;
};

}  // namespace skein
