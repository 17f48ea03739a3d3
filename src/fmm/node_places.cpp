#include "fmm/node_places.hpp"

#include <algorithm>

namespace skein {

NodePlaces::NodePlaces(std::vector<IndexRange> runs) {
  std::sort(runs.begin(), runs.end(), [](const IndexRange a, const IndexRange b) { return a.first < b.first; });
  int end = 0;  // of all, as far as pieces go
  for (const IndexRange& run : runs) {
    const int first = std::max(run.first, end), n_new = run.first + run.count - first;
    if (n_new <= 0) continue;
    if (!pieces_.empty() && first == end)
      pieces_.back().of_all.count += n_new;
    else
      pieces_.push_back({{first, n_new}, next_});
    next_ += n_new;
    end = first + n_new;
  }
}

IndexRange NodePlaces::find(const IndexRange of_all) const {
  const auto behind = std::upper_bound(pieces_.begin(), pieces_.end(), of_all.first,
                                       [](const int place, const Piece& piece) { return place < piece.of_all.first; });
  if (behind == pieces_.begin()) return {0, of_all.count};
  const Piece& piece = *(behind - 1);
  const int offset = of_all.first - piece.of_all.first;
  if (offset + of_all.count > piece.of_all.count) return {0, of_all.count};
  return {piece.first + offset, of_all.count};
}

std::vector<IndexRange> NodePlaces::list_between(const IndexRange of_all) const {
  std::vector<IndexRange> runs;
  for (const Piece& piece : pieces_) {
    const IndexRange run = common(piece.of_all, of_all);
    if (run.count > 0) runs.push_back(run);
  }
  return runs;
}

}  // namespace skein
