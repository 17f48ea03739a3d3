#include <skein/core/counter_random.hpp>

namespace skein {
namespace {

struct Product {
  std::uint32_t high, low;
};

Product multiply(const std::uint32_t a, const std::uint32_t b) {
  const std::uint64_t product = std::uint64_t{a} * b;
  return {static_cast<std::uint32_t>(product >> 32), static_cast<std::uint32_t>(product)};
}

double to_unit_interval(const std::uint32_t high, const std::uint32_t low) {
  const std::uint64_t bits = (std::uint64_t{high} << 32 | low) >> 11;
  return static_cast<double>(bits) * 0x1p-53;
}

}  // namespace

std::array<std::uint32_t, 4> philox(std::array<std::uint32_t, 4> counter, std::array<std::uint32_t, 2> key) {
  constexpr int n_rounds = 10;
  for (int round = 0; round < n_rounds; ++round) {
    const Product first = multiply(0xD2511F53u, counter[0]);
    const Product second = multiply(0xCD9E8D57u, counter[2]);
    counter = {second.high ^ counter[1] ^ key[0], second.low, first.high ^ counter[3] ^ key[1], first.low};
    key = {key[0] + 0x9E3779B9u, key[1] + 0xBB67AE85u};
  }
  return counter;
}

std::array<double, 2> CounterRandom::draw(const std::uint64_t number) const {
  const auto bits =
      philox({static_cast<std::uint32_t>(number), static_cast<std::uint32_t>(number >> 32), stream_, purpose_},
             {static_cast<std::uint32_t>(seed_), static_cast<std::uint32_t>(seed_ >> 32)});
  return {to_unit_interval(bits[0], bits[1]), to_unit_interval(bits[2], bits[3])};
}

}  // namespace skein
