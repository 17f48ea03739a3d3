#include <skein/io/event_log.hpp>

#include <fmt/format.h>

#include <cmath>

namespace skein {
namespace {

std::string json_string(const std::string_view text) {
  std::string result = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') {
      result += '\\';
      result += c;
    } else if (static_cast<unsigned char>(c) < 0x20) {
      result += fmt::format("\\u{:04x}", static_cast<int>(c));
    } else {
      result += c;
    }
  }
  return result + '"';
}

std::string as_json(const EventLog::Value& value) {
  if (const bool* truth = std::get_if<bool>(&value)) return *truth ? "true" : "false";
  if (const std::int64_t* whole = std::get_if<std::int64_t>(&value)) return fmt::format("{}", *whole);
  if (const double* real = std::get_if<double>(&value)) return std::isfinite(*real) ? fmt::format("{}", *real) : "null";
  return json_string(std::get<std::string>(value));
}

}  // namespace

EventLog::EventLog(const std::filesystem::path& path) : file_(path), start_(std::chrono::steady_clock::now()) {}

void EventLog::write(const std::string_view event, const Fields& fields) {
  const double wall = std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
  std::string line = fmt::format("{{\"event\": {}, \"wall\": {:.3f}", json_string(event), wall);
  for (const auto& [name, value] : fields) line += fmt::format(", {}: {}", json_string(name), as_json(value));
  file_.write_line(line + '}');
}

}  // namespace skein
