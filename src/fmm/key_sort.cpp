#include "fmm/key_sort.hpp"

#include <algorithm>
#include <utility>
#include <vector>

namespace skein {
namespace {

/// Digits of the keys: a thread of a host has a cache for the counts of many.
template <class Space>
inline constexpr int digit_bits = on_host<Space> ? 11 : 4;
template <class Space>
inline constexpr int n_digits = 1 << digit_bits<Space>;

constexpr int tile_keys = 128;  // that a team compares its own with at once

/// Keys of a thread.
template <class Space>
int chunk_keys(const int n) {
  constexpr int most_chunks = 16;
  return on_host<Space> ? math::larger(32768, math::ceil_div(n, most_chunks)) : 32;
}

/// One stable pass by one digit: threads count the digits of their chunks, a scan over (digit, chunk) gives each chunk
/// its places.
template <class Space>
void sort_pass(const Space& space, const KeyedOrder<Space>& from, const KeyedOrder<Space>& to, const int n,
               const int shift, const Kokkos::View<int*, Space>& place) {
  const int size = chunk_keys<Space>(n), n_chunks = math::ceil_div(n, size);
  const auto from_key = from.key, to_key = to.key;
  const auto from_order = from.order, to_order = to.order;
  const auto places = place;
  launch<Space>(
      "skein::sort_by_key_count", space, Calls{n_chunks, 2.0 * size}, KOKKOS_LAMBDA(const int chunk) {
        int count[n_digits<Space>] = {};
        const int last = math::smaller(n, (chunk + 1) * size);
        for (int i = chunk * size; i < last; ++i)
          ++count[static_cast<int>(from_key(i) >> shift) & (n_digits<Space> - 1)];
        for (int digit = 0; digit < n_digits<Space>; ++digit) places(digit * n_chunks + chunk) = count[digit];
      });
  scan_in_place(space, place, n_digits<Space> * n_chunks);
  launch<Space>(
      "skein::sort_by_key_move", space, Calls{n_chunks, 4.0 * size}, KOKKOS_LAMBDA(const int chunk) {
        int next[n_digits<Space>];
        for (int digit = 0; digit < n_digits<Space>; ++digit) next[digit] = places(digit * n_chunks + chunk);
        const int last = math::smaller(n, (chunk + 1) * size);
        for (int i = chunk * size; i < last; ++i) {
          const std::uint64_t key = from_key(i);
          const int at = next[static_cast<int>(key >> shift) & (n_digits<Space> - 1)]++;
          to_key(at) = key;
          to_order(at) = from_order(i);
        }
      });
}

/// Where each of a team's keys goes: behind those that are smaller, or equal and before it.
template <class Space>
struct FindPlaces {
  using Policy = Kokkos::TeamPolicy<Space>;
  using Team = typename Policy::member_type;
  using Tile = Kokkos::View<std::uint64_t*, typename Space::scratch_memory_space, Kokkos::MemoryUnmanaged>;

  KeyedOrder<Space> from, to;
  int n;

  KOKKOS_INLINE_FUNCTION void operator()(const Team& team) const {
    const Tile tile(team.team_scratch(0), tile_keys);
    const int own = team.league_rank() * team.team_size() + team.team_rank();
    const std::uint64_t key = from.key(math::smaller(own, n - 1));
    int place = 0;
    for (int first = 0; first < n; first += tile_keys) {
      const int count = math::smaller(tile_keys, n - first);
      team.team_barrier();  // the tile may be overwritten
      for (int k = team.team_rank(); k < count; k += team.team_size()) tile(k) = from.key(first + k);
      team.team_barrier();  // the tile is complete
      for (int k = 0; k < count; ++k) place += tile(k) < key || (tile(k) == key && first + k < own);
    }
    if (own >= n) return;
    to.key(place) = key;
    to.order(place) = from.order(own);
  }
};

template <class Space>
void sort_few(const Space& space, const KeyedOrder<Space>& from, const KeyedOrder<Space>& to, const int n) {
  using Find = FindPlaces<Space>;
  constexpr int team_size = on_host<Space> ? 1 : 64;
  typename Find::Policy policy(space, math::ceil_div(n, team_size), team_size);
  policy.set_scratch_size(0, Kokkos::PerTeam(static_cast<int>(Find::Tile::shmem_size(tile_keys))));
  Kokkos::parallel_for("skein::sort_few", policy, Find{from, to, n});
}

/// So many keys are sooner sorted by one thread of a host than by digits, whose counts are more.
constexpr int few_of_thread = 16384;

template <class Space>
void sort_by_thread(const KeyedOrder<Space>& from, const KeyedOrder<Space>& to, const int n) {
  struct Keyed {
    std::uint64_t key;
    int place;
    bool operator<(const Keyed& other) const { return key < other.key || (key == other.key && place < other.place); }
  };
  std::vector<Keyed> keyed(static_cast<std::size_t>(n));
  for (int i = 0; i < n; ++i) keyed[static_cast<std::size_t>(i)] = {from.key(i), i};
  std::sort(keyed.begin(), keyed.end());
  for (int i = 0; i < n; ++i) {
    to.key(i) = keyed[static_cast<std::size_t>(i)].key;
    to.order(i) = from.order(keyed[static_cast<std::size_t>(i)].place);
  }
}

/// Fibers come in order, and nodes move little.
template <class Space>
bool is_sorted(const Space& space, const KeyedOrder<Space>& sorted, const int n) {
  const auto key = sorted.key;
  int n_descents = 0;
  launch_reduction<Space>(
      "skein::sort_by_key_check", space, Calls{math::larger(0, n - 1), 1.5},
      KOKKOS_LAMBDA(const int i, int& sum) { sum += key(i) > key(i + 1); }, Kokkos::Sum<int>(n_descents));
  return n_descents == 0;
}

}  // namespace

template <class Space>
void sort_by_key(const Space& space, KeyedOrder<Space>& sorted, const int n, const int n_bits, SortSpace<Space>& memory,
                 const int few) {
  if (n > few && is_sorted(space, sorted, n)) return;
  memory.spare.require(static_cast<std::size_t>(n));
  if (n <= few) {
    sort_few(space, sorted, memory.spare, n);
    std::swap(sorted, memory.spare);
    return;
  }
  if constexpr (on_host<Space>) {
    if (n <= few_of_thread) {
      sort_by_thread(sorted, memory.spare, n);
      std::swap(sorted, memory.spare);
      return;
    }
  }
  require_extent(memory.place, static_cast<std::size_t>(n_digits<Space> * math::ceil_div(n, chunk_keys<Space>(n)) + 1),
                 "skein::key_sort::sort_places");
  for (int shift = 0; shift < n_bits; shift += digit_bits<Space>) {
    sort_pass(space, sorted, memory.spare, n, shift, memory.place);
    std::swap(sorted, memory.spare);
  }
}

#define SKEIN_INSTANTIATE(S) template void sort_by_key<S>(const S&, KeyedOrder<S>&, int, int, SortSpace<S>&, int);
SKEIN_FOR_EACH_EXEC_SPACE(SKEIN_INSTANTIATE)

}  // namespace skein
