#pragma once

#include <skein/io/line_file.hpp>

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

namespace skein {

/// events.jsonl, for programs: one JSON object a line.
class EventLog {
 public:
  using Value = std::variant<bool, std::int64_t, double, std::string>;
  using Fields = std::vector<std::pair<std::string, Value>>;

  /// @throws Error(io_error), as write()
  explicit EventLog(const std::filesystem::path& path);

  /// Writes {"event": name, "wall": seconds since the log was opened, fields...}. Doubles keep all their digits; those
  /// that JSON lacks (NaN, infinity) become null, and bytes that are no UTF-8, as a file's name may have, U+FFFD.
  void write(std::string_view event, const Fields& fields = {});

 private:
  LineFile file_;
  std::chrono::steady_clock::time_point start_;
};

}  // namespace skein
