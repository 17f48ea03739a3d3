#include "fmm/morton.hpp"

#include <utility>
#include <vector>

namespace skein {
namespace {

constexpr int digit_bits = 11;
constexpr int n_digits = 1 << digit_bits;
constexpr int min_chunk = 32768;
constexpr int max_chunks = 16;

/// One stable pass by one digit: chunks count their digits, a scan over (digit, chunk) gives each chunk its places.
void sort_pass(const std::uint64_t* key, const int* order, const int n, const int shift, std::uint64_t* sorted_key,
               int* sorted_order, std::vector<int>& place) {
  const int n_chunks = math::larger(1, math::smaller(max_chunks, n / min_chunk));
  const auto chunk_first = [=](const int chunk) {
    return static_cast<int>(static_cast<std::int64_t>(n) * chunk / n_chunks);
  };
  place.assign(static_cast<std::size_t>(n_chunks) * n_digits, 0);
  int* const places = place.data();
  const auto count = [=](const int chunk) {
    int* const counts = places + chunk * n_digits;
    for (int i = chunk_first(chunk); i < chunk_first(chunk + 1); ++i) ++counts[key[i] >> shift & (n_digits - 1)];
  };
  const auto move = [=](const int chunk) {
    int* const next = places + chunk * n_digits;
    for (int i = chunk_first(chunk); i < chunk_first(chunk + 1); ++i) {
      const int to = next[key[i] >> shift & (n_digits - 1)]++;
      sorted_key[to] = key[i];
      sorted_order[to] = order[i];
    }
  };
  const Kokkos::RangePolicy<HostSpace, Kokkos::Schedule<Kokkos::Dynamic>> chunks(HostSpace(), 0, n_chunks);
  if (n_chunks == 1)
    count(0);
  else
    Kokkos::parallel_for("skein::sort_by_key_count", chunks, count);
  int sum = 0;
  for (int digit = 0; digit < n_digits; ++digit)
    for (int chunk = 0; chunk < n_chunks; ++chunk) sum += std::exchange(places[chunk * n_digits + digit], sum);
  if (n_chunks == 1)
    move(0);
  else
    Kokkos::parallel_for("skein::sort_by_key_move", chunks, move);
}

}  // namespace

void sort_by_key(const Kokkos::View<std::uint64_t*, HostSpace>& key, const Kokkos::View<int*, HostSpace>& order,
                 const int n, const int n_bits, const Kokkos::View<std::uint64_t*, HostSpace>& spare_key,
                 const Kokkos::View<int*, HostSpace>& spare_order) {
  std::uint64_t *from_key = key.data(), *to_key = spare_key.data();
  int *from = order.data(), *to = spare_order.data();
  std::vector<int> place;
  bool sorted = true;  // fibers come in order, and nodes move little
  for (int i = 1; i < n && sorted; ++i) sorted = from_key[i - 1] <= from_key[i];
  if (sorted) return;
  int shift = 0;
  for (; shift < n_bits; shift += digit_bits) {
    sort_pass(from_key, from, n, shift, to_key, to, place);
    std::swap(from_key, to_key);
    std::swap(from, to);
  }
  if (from != order.data())
    for (int i = 0; i < n; ++i) {
      order(i) = from[i];
      key(i) = from_key[i];
    }
}

}  // namespace skein
