#include <skein/analysis/crossing.hpp>
#include <skein/core/error.hpp>

#include "segment_passage.hpp"

#include <algorithm>
#include <cstdlib>
#include <limits>
#include <set>
#include <utility>

namespace skein {
namespace {

/// First sections of two pieces, one on each line.
using PiecePair = std::pair<int, int>;
using PiecePairs = std::set<PiecePair>;

/// Those next to one, itself included.
template <class Visit>
void for_each_neighbour(const PiecePairs& pairs, const PiecePair& one, const Visit& visit) {
  for (int i = -1; i <= 1; ++i)
    for (int j = -1; j <= 1; ++j)
      if (const auto found = pairs.find({one.first + i, one.second + j}); found != pairs.end()) visit(*found);
}

/// Groups of pairs that hang together: a passage through a joint of pieces is seen by several pairs, but is one.
int count_groups(PiecePairs pairs) {
  int n_groups = 0;
  for (; !pairs.empty(); ++n_groups) {
    std::vector<PiecePair> open{*pairs.begin()};
    pairs.erase(pairs.begin());
    while (!open.empty()) {
      const PiecePair one = open.back();
      open.pop_back();
      const std::size_t first_new = open.size();
      for_each_neighbour(pairs, one, [&](const PiecePair& neighbour) { open.push_back(neighbour); });
      for (std::size_t i = first_new; i < open.size(); ++i) pairs.erase(open[i]);
    }
  }
  return n_groups;
}

/// What the pieces of two lines, or of one, do to each other.
class Encounters {
 public:
  void add(const PiecePair& pair, const MovingPiece& p, const MovingPiece& q, const double meeting) {
    const bool met = compute_distance(p, q, 0.0) <= meeting, meets = compute_distance(p, q, 1.0) <= meeting;
    if (met) met_.insert(pair);
    if (meets) meet_.insert(pair);
    if (met || meets) return;
    const PieceEncounter encounter = find_passages(p, q, meeting);
    if (encounter.rises) rises_.insert(pair);
    if (encounter.falls) falls_.insert(pair);
    if (encounter.is_planar && come_near(p, q, meeting)) slide_.insert(pair);
  }

  int count() const {
    const int n_met = count_groups(met_), n_meet = count_groups(meet_);
    const int n_passages = count_groups(away_from_meetings(rises_)) + count_groups(away_from_meetings(falls_));
    // In one plane a place where lines meet moves along them from piece to piece; only where there is none, pieces that
    // slide over each other have passed.
    const int n_slides = n_met + n_meet + n_passages == 0 ? count_groups(slide_) : 0;
    return n_passages + std::max(0, n_meet - n_met) + n_slides;
  }

 private:
  /// A meeting counts where it begins, and pieces that leave each other after it have not passed again.
  PiecePairs away_from_meetings(const PiecePairs& pairs) const {
    PiecePairs away;
    for (const PiecePair& pair : pairs) {
      bool is_near = false;
      for (const PiecePairs* meetings : {&met_, &meet_})
        for_each_neighbour(*meetings, pair, [&](const PiecePair&) { is_near = true; });
      if (!is_near) away.insert(pair);
    }
    return away;
  }

  PiecePairs met_, meet_;     ///< pieces that meet at the first moment, at the second
  PiecePairs rises_, falls_;  ///< that pass through each other
  PiecePairs slide_;          ///< that meet in between, in one plane
};

/// Where a part of a line is between two moments.
struct SweptBox {
  Vec3 low{infinity, infinity, infinity}, high{-infinity, -infinity, -infinity};

  void take(const Vec3 a, const Vec3 b) {
    low = {std::min(low.x, a.x), std::min(low.y, a.y), std::min(low.z, a.z)};
    high = {std::max(high.x, b.x), std::max(high.y, b.y), std::max(high.z, b.z)};
  }
  void take(const Vec3 point) { take(point, point); }
  void take(const SweptBox& box) { take(box.low, box.high); }
  bool is_within(const double distance, const SweptBox& o) const {
    return low.x <= o.high.x + distance && o.low.x <= high.x + distance && low.y <= o.high.y + distance &&
           o.low.y <= high.y + distance && low.z <= o.high.z + distance && o.low.z <= high.z + distance;
  }

  static constexpr double infinity = std::numeric_limits<double>::infinity();
};

constexpr int pieces_per_block = 16;

/// One fiber's line in pieces from section to section, with boxes about them, about blocks of them and about all.
struct SweptLine {
  const Fiber& fiber;
  std::vector<MovingPiece> pieces;
  std::vector<SweptBox> piece_boxes, blocks;
  SweptBox box;

  SweptLine(const Fiber& of, const std::vector<Vec3>& before, const std::vector<Vec3>& after) : fiber(of) {
    pieces.reserve(fiber.config.sections);
    piece_boxes.reserve(fiber.config.sections);
    for (int i = 0; i + 1 < fiber.config.sections; ++i) {
      const auto s = static_cast<std::size_t>(fiber.first_section + i);
      const MovingPiece& piece = pieces.emplace_back(MovingPiece{before[s], before[s + 1], after[s], after[s + 1]});
      SweptBox& swept = piece_boxes.emplace_back();
      for (const Vec3 end : {piece.first_before, piece.last_before, piece.first_after, piece.last_after})
        swept.take(end);
      if (i % pieces_per_block == 0) blocks.emplace_back();
      blocks.back().take(swept);
      box.take(swept);
    }
  }
  int n_pieces() const { return static_cast<int>(pieces.size()); }
};

int count_crossings(const SweptLine& one, const SweptLine& other) {
  const bool is_same = &one == &other;
  const double meeting = meeting_distance * std::min(one.fiber.config.radius, other.fiber.config.radius);
  Encounters encounters;
  for (std::size_t b = 0; b < one.blocks.size(); ++b)
    for (std::size_t c = is_same ? b : 0; c < other.blocks.size(); ++c) {
      if (!one.blocks[b].is_within(meeting, other.blocks[c])) continue;
      const int first = static_cast<int>(b) * pieces_per_block, first_other = static_cast<int>(c) * pieces_per_block;
      const int end = std::min(first + pieces_per_block, one.n_pieces());
      const int end_other = std::min(first_other + pieces_per_block, other.n_pieces());
      for (int i = first; i < end; ++i)
        for (int j = is_same ? std::max(first_other, i + 1 + one.fiber.distant_sections()) : first_other; j < end_other;
             ++j)
          if (one.piece_boxes[i].is_within(meeting, other.piece_boxes[j]))
            encounters.add({i, j}, one.pieces[i], other.pieces[j], meeting);
    }
  return encounters.count();
}

}  // namespace

int count_crossings(const std::vector<Fiber>& fibers, const std::vector<Vec3>& before, const std::vector<Vec3>& after) {
  const auto n_sections = static_cast<std::size_t>(count_sections(fibers));
  SKEIN_REQUIRE(before.size() == n_sections && after.size() == n_sections, "a centroid for each section is needed");
  std::vector<SweptLine> lines;
  lines.reserve(fibers.size());
  for (const Fiber& fiber : fibers) lines.emplace_back(fiber, before, after);
  // From left to right: a line meets none that begins behind its end.
  std::vector<const SweptLine*> order;
  double margin = 0.0;
  for (const SweptLine& line : lines) {
    order.push_back(&line);
    margin = std::max(margin, meeting_distance * line.fiber.config.radius);
  }
  std::sort(order.begin(), order.end(),
            [](const SweptLine* a, const SweptLine* b) { return a->box.low.x < b->box.low.x; });
  int n_crossings = 0;
  for (std::size_t a = 0; a < order.size(); ++a)
    for (std::size_t b = a; b < order.size() && order[b]->box.low.x <= order[a]->box.high.x + margin; ++b)
      if (order[a]->box.is_within(margin, order[b]->box)) n_crossings += count_crossings(*order[a], *order[b]);
  return n_crossings;
}

}  // namespace skein
