#pragma once

#include <utility>
#include <vector>

namespace skein {

/// All pairs of n players, round by round, so that nobody plays twice in a round: by the circle method, in which the
/// last player stays and the others rotate. Where their number is odd, one of them rests.
inline std::vector<std::pair<int, int>> list_tournament(const int n_players) {
  std::vector<std::pair<int, int>> matches;
  const int n_rotating = n_players % 2 == 0 ? n_players - 1 : n_players;
  for (int round = 1; round <= n_rotating; ++round)
    for (int match = 0; match < (n_rotating + 1) / 2; ++match) {
      const int one = match == 0 ? n_rotating : (round + match) % n_rotating;
      if (one < n_players)
        matches.emplace_back(one, match == 0 ? round % n_rotating : (round - match + n_rotating) % n_rotating);
    }
  return matches;
}

}  // namespace skein
