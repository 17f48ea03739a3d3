#pragma once

#include <skein/arrays/types.hpp>

#include <atomic>
#include <cstddef>
#include <string>
#include <thread>
#include <vector>

namespace skein {

/// Two tiles of nodes that meet, or a tile alone (one == other).
struct Match {
  int one = 0, other = 0;
  int turn_of_one = 0, turn_of_other = 0;  ///< matches that the tile has before this one
};

/// Numbers the turns of matches that stand in the order in which their tiles shall meet.
inline void count_turns(const int n_tiles, std::vector<Match>& matches) {
  std::vector<int> n_met(static_cast<std::size_t>(n_tiles), 0);
  for (Match& match : matches) {
    match.turn_of_one = n_met[static_cast<std::size_t>(match.one)]++;
    if (match.other != match.one) match.turn_of_other = n_met[static_cast<std::size_t>(match.other)]++;
  }
}

/// Calls play(match) for all matches. Threads claim them in order, and a match waits for the turns before it of both
/// its tiles: no two matches of a tile run at once, and every node receives its contributions in the same order
/// whatever the number of threads, without buffers, atomics on velocities or barriers. The first unfinished match never
/// waits.
template <class Play>
void play_in_order(const std::string& label, const HostSpace& space, const int n_tiles,
                   const std::vector<Match>& matches, const Play& play) {
  std::vector<std::atomic<int>> finished(static_cast<std::size_t>(n_tiles));
  std::atomic<int> next_match{0};
  const auto wait_for = [&](const int tile, const int turn) {
    int spins = 0;
    while (finished[static_cast<std::size_t>(tile)].load(std::memory_order_acquire) < turn)
      if (++spins > 1000) std::this_thread::yield();
  };
  const auto finish = [&](const int tile, const int turn) {
    finished[static_cast<std::size_t>(tile)].store(turn + 1, std::memory_order_release);
  };
  const int n_matches = static_cast<int>(matches.size());
  Kokkos::parallel_for(label, Kokkos::RangePolicy<HostSpace>(space, 0, space.concurrency()), [&](int) {
    for (int m = next_match.fetch_add(1); m < n_matches; m = next_match.fetch_add(1)) {
      const Match& match = matches[static_cast<std::size_t>(m)];
      wait_for(match.one, match.turn_of_one);
      if (match.other != match.one) wait_for(match.other, match.turn_of_other);
      play(match);
      finish(match.one, match.turn_of_one);
      if (match.other != match.one) finish(match.other, match.turn_of_other);
    }
  });
}

}  // namespace skein
