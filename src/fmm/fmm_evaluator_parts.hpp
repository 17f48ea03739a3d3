#pragma once

#include "fmm/fmm_evaluator.hpp"

#include <algorithm>

// What FmmEvaluator does where ranks have a part of the tree each: its sources are the targets, and of those each rank
// is given its own.

namespace skein {

template <class Workers>
bool FmmEvaluator<Workers>::take_part(const Sources& own, const RankParts& parts) {
  SKEIN_REQUIRE(ranks_ != nullptr && Workers::Exchange::makes_parts, "of this sum ranks have no parts");
  const bool is_finite = take(own, own.position);
  given_ = parts;
  const std::vector<double> all = list_from_all(*ranks_, {is_finite ? 1.0 : 0.0, blobs_.smallest, blobs_.largest});
  bool are_finite = true;
  for (std::size_t rank = 0; rank < parts.count.size(); ++rank) {
    are_finite = are_finite && all[3 * rank] != 0.0;
    if (parts.count[rank] == 0) continue;
    blobs_.smallest = std::min(blobs_.smallest, all[3 * rank + 1]);
    blobs_.largest = std::max(blobs_.largest, all[3 * rank + 2]);
  }
  return are_finite;
}

template <class Workers>
void FmmEvaluator<Workers>::require_part(const OctreeRules& rules, const bool may_keep, const double scale) {
  if constexpr (Workers::Exchange::makes_parts) {
    const double one_blob = blobs_.smallest == blobs_.largest ? blobs_.largest : 0.0;
    if (may_keep && keeping_.may_serve(rules) && exchange_.keeps_part(tree_, nodes_, one_blob, scale, sorted_)) return;
    exchange_.make_part(*ranks_, given_, rules, tree_, nodes_, one_blob, scale, sorted_);
    note_new_tree(rules);
  }
}

template <class Workers>
std::vector<Vec3> FmmEvaluator<Workers>::sample(const EvenSample& sample) const {
  if constexpr (Workers::Exchange::makes_parts) {
    if (is_part_) {
      // Of others' rows there is nothing here, and nobody asks for them.
      std::vector<Vec3> list(static_cast<std::size_t>(sample.n_chosen));
      const HostVectors& velocity = exchange_.velocity();
      const bool has_all = owners.count.empty();
      const int first = has_all ? 0 : static_cast<int>(given_.first[static_cast<std::size_t>(ranks_->rank())]);
      for (int i = 0; i < sample.n_chosen; ++i) {
        const int row = sample.index(i) - first;
        if (row >= 0 && row < velocity.extent_int(0)) list[static_cast<std::size_t>(i)] = load(velocity, row);
      }
      return list;
    }
  }
  return read_sample<Space>(space_, own_velocity_, sample);
}

}  // namespace skein
