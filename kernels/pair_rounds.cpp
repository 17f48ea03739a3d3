#include "kernels/pair_rounds.hpp"

#include <algorithm>

namespace skein {

int PairRounds::top_level() const {
  int level = 0;
  while (1 << level < n_tiles) ++level;
  return level;
}

std::vector<IndexRange> PairRounds::share(const int n_processes) const {
  // In halves of a round: 1, 2, 2, ...
  const auto round_at = [&](const int process) {
    const int halves = static_cast<int>(static_cast<long long>(2 * n_tiles - 1) * process / n_processes);
    return process == n_processes ? n_tiles : (halves + 1) / 2;
  };
  std::vector<IndexRange> shares;
  for (int process = 0; process < n_processes; ++process)
    shares.push_back({round_at(process), round_at(process + 1) - round_at(process)});
  return shares;
}

std::vector<RoundBlock> PairRounds::list_blocks(const IndexRange rounds) const {
  std::vector<RoundBlock> blocks;
  const int last = rounds.first + rounds.count;
  for (int round = rounds.first; round < last;) {
    int level = 0;
    // Twice as large, if the rounds begin with it and hold all of it that there is.
    while (level < top_level() && round % (2 << level) == 0 && std::min(round + (2 << level), n_tiles) <= last) ++level;
    blocks.push_back({level, round >> level});
    round = std::min(round + (1 << level), n_tiles);
  }
  return blocks;
}

}  // namespace skein
