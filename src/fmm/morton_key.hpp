#pragma once

#include <skein/core/math.hpp>

#include <cstdint>

namespace skein {

/// Morton keys: the cell coordinates of a node, their bits taken in turn. Nodes sorted by key are sorted by boxes of
/// every level at once. Three times max_key_depth bits must fit a word.
inline constexpr int max_key_depth = 20;

/// Spreads the low 21 bits of x to every third bit.
SKEIN_INLINE_FUNCTION std::uint64_t spread_bits(std::uint64_t x) {
  x &= 0x1fffff;
  x = (x | x << 32) & 0x1f00000000ffffULL;
  x = (x | x << 16) & 0x1f0000ff0000ffULL;
  x = (x | x << 8) & 0x100f00f00f00f00fULL;
  x = (x | x << 4) & 0x10c30c30c30c30c3ULL;
  x = (x | x << 2) & 0x1249249249249249ULL;
  return x;
}

/// Bit c of every group of three belongs to axis c.
SKEIN_INLINE_FUNCTION std::uint64_t morton_key(const std::uint64_t x, const std::uint64_t y, const std::uint64_t z) {
  return spread_bits(x) | spread_bits(y) << 1 | spread_bits(z) << 2;
}

}  // namespace skein
