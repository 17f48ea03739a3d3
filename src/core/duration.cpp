#include <skein/core/duration.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>

namespace skein {
namespace {

// from_chars also takes "inf" and "-1", which no duration is.
std::optional<double> parse_count(const std::string& text) {
  if (text.empty() || !std::isdigit(static_cast<unsigned char>(text.front()))) return std::nullopt;
  double count = 0.0;
  const char* last = text.data() + text.size();
  const auto [end, error] = std::from_chars(text.data(), last, count);
  if (error != std::errc() || end != last || !std::isfinite(count)) return std::nullopt;
  return count;
}

std::optional<double> parse_clock(const std::string& text) {
  double seconds = 0.0;
  int n_parts = 0;
  for (std::size_t begin = 0; begin <= text.size(); ++n_parts) {
    const auto end = std::min(text.find(':', begin), text.size());
    const auto part = parse_count(text.substr(begin, end - begin));
    if (!part || (n_parts > 0 && *part >= 60.0)) return std::nullopt;
    seconds = 60.0 * seconds + *part;
    begin = end + 1;
  }
  if (n_parts > 3) return std::nullopt;
  return seconds;
}

double seconds_of_unit(const char unit) {
  switch (unit) {
    case 's':
      return 1.0;
    case 'm':
      return 60.0;
    case 'h':
      return 3600.0;
    case 'd':
      return 86400.0;
    default:
      return 0.0;
  }
}

}  // namespace

std::optional<double> parse_duration(const std::string& text) {
  if (text.empty()) return std::nullopt;
  std::optional<double> seconds;
  if (text.find(':') != std::string::npos) {
    seconds = parse_clock(text);
  } else if (const double unit = seconds_of_unit(text.back()); unit > 0.0) {
    seconds = parse_count(text.substr(0, text.size() - 1));
    if (seconds) *seconds *= unit;
  } else {
    seconds = parse_count(text);
  }
  if (seconds && !(*seconds > 0.0)) return std::nullopt;
  return seconds;
}

std::string format_duration(const double seconds) {
  if (!(seconds < 1e10)) return "for ever";
  const auto total = std::llround(std::max(seconds, 0.0));
  if (total < 60) return fmt::format("{} s", total);
  if (total < 3600) return fmt::format("{} min {:02} s", total / 60, total % 60);
  if (total < 86400) return fmt::format("{} h {:02} min", total / 3600, total / 60 % 60);
  return fmt::format("{} d {:02} h", total / 86400, total / 3600 % 24);
}

}  // namespace skein
