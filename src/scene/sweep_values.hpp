#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace skein {

enum class SweepSpacing { linear, logarithmic, random, random_logarithmic };

/// Values of a parameter that is not listed.
struct SweepRange {
  double from = 0.0, to = 0.0;
  std::size_t count = 0;
  SweepSpacing spacing = SweepSpacing::linear;
};

/// Both ends are among the values that are not drawn. A draw is named by (seed, key, its number): it depends neither on
/// other parameters nor on how many there are.
/// @param range  for logarithms with ends above 0
std::vector<double> spread_values(const SweepRange& range, std::uint64_t seed, const std::string& key);

}  // namespace skein
