#include "sweep_values.hpp"

#include <skein/core/counter_random.hpp>

#include <cmath>

namespace skein {
namespace {

/// FNV-1a of 32 bits: which stream of random numbers a key has, for good.
std::uint32_t hash_key(const std::string& key) {
  std::uint32_t hash = 2166136261u;
  for (const char c : key) hash = (hash ^ static_cast<unsigned char>(c)) * 16777619u;
  return hash;
}

}  // namespace

std::vector<double> spread_values(const SweepRange& range, const std::uint64_t seed, const std::string& key) {
  const bool is_drawn = range.spacing == SweepSpacing::random || range.spacing == SweepSpacing::random_logarithmic;
  const bool is_logarithmic =
      range.spacing == SweepSpacing::logarithmic || range.spacing == SweepSpacing::random_logarithmic;
  const CounterRandom random(seed, CounterRandom::Purpose::sweep, hash_key(key));
  std::vector<double> values;
  for (std::size_t i = 0; i < range.count; ++i) {
    const double steps = range.count > 1 ? static_cast<double>(range.count - 1) : 1.0;
    const double share = is_drawn ? random.draw(i)[0] : static_cast<double>(i) / steps;
    values.push_back(is_logarithmic ? range.from * std::pow(range.to / range.from, share)
                                    : range.from + (range.to - range.from) * share);
  }
  // No rounding of the last one: people compare with what they wrote.
  if (!is_drawn && range.count > 1) values.back() = range.to;
  return values;
}

}  // namespace skein
