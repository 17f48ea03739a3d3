#pragma once

#include <optional>
#include <string>

namespace skein {

/// Seconds of "90", "90s", "15m", "1.5h", "2d" or "[hours:]minutes:seconds"; nothing if it is none of them, or not
/// above 0.
std::optional<double> parse_duration(const std::string& text);

/// "42 s", "3 min 05 s", "2 h 10 min", "5 d 03 h".
std::string format_duration(double seconds);

}  // namespace skein
