#pragma once

#include <array>
#include <cstdint>

namespace skein {

/// Philox4x32 with 10 rounds: 128 random bits for each counter, so that any number can be drawn by name, in any order.
/// Source: Salmon, Moraes, Dror, Shaw, Proc. SC11 (2011).
std::array<std::uint32_t, 4> philox(std::array<std::uint32_t, 4> counter, std::array<std::uint32_t, 2> key);

/// Random numbers named by (seed, purpose, stream, draw): the same for any order in which they are asked for.
class CounterRandom {
 public:
  enum class Purpose : std::uint32_t { start_noise = 1, placement = 2, sweep = 3 };

  /// @param stream  a fiber, or whatever else draws for itself
  CounterRandom(std::uint64_t seed, Purpose purpose, std::uint32_t stream)
      : seed_(seed), purpose_(static_cast<std::uint32_t>(purpose)), stream_(stream) {}

  /// Two independent numbers, evenly in [0, 1).
  std::array<double, 2> draw(std::uint64_t number) const;

 private:
  std::uint64_t seed_;
  std::uint32_t purpose_, stream_;
};

}  // namespace skein
