#pragma once

#include "fmm/box_passes.hpp"
#include "fmm/tail_moments.hpp"

#include <type_traits>
#include <vector>

namespace skein {

/// Levels whose boxes follow each other, as one range.
inline std::vector<IndexRange> join_levels(const std::vector<IndexRange>& boxes_of_level) {
  std::vector<IndexRange> joined;
  for (std::size_t level = first_far_level; level < boxes_of_level.size(); ++level) {
    const IndexRange boxes = boxes_of_level[level];
    if (boxes.count == 0) continue;
    if (!joined.empty() && joined.back().first + joined.back().count == boxes.first)
      joined.back().count += boxes.count;
    else
      joined.push_back(boxes);
  }
  return joined;
}

/// From the sources up, across, and down to the coefficients of leaves. Boxes that are not passed over stay as they
/// are.
template <class Workers, class Space, class Real, class Field>
void compute_coefficients(const Workers& workers, const Passes<Space, Real, Field>& passes, const PassedBoxes& boxes) {
  const int n_levels = passes.n_levels;
  if (n_levels <= first_far_level) return;
  const auto at = [](const std::vector<IndexRange>& ranges, const int level) {
    return ranges[static_cast<std::size_t>(level)];
  };
  using FromSources = std::conditional_t<std::is_same_v<Field, TailField>, SourcesToMoments<Space, Real>,
                                         SourcesToLeaves<Space, Real, Field>>;
  const FromSources from_sources{passes};
  const ChildrenToParents<Space, Real, Field> up{passes};
  for (const IndexRange run : join_levels(boxes.sources)) workers.for_boxes("skein::run_p2m", run, from_sources);
  for (int level = n_levels - 2; level >= first_far_level; --level)
    workers.for_boxes("skein::run_m2m", at(boxes.sources, level), up);
  if (boxes.exchange) boxes.exchange();
  for (const int b : boxes.of_all) {
    workers.for_boxes("skein::run_p2m", {b, 1}, from_sources);
    workers.for_boxes("skein::run_m2m", {b, 1}, up);
  }
  workers.transfer(passes, boxes.targets);
  if (passes.x_list.n_entries > 0)
    for (const IndexRange run : join_levels(boxes.targets))
      workers.for_boxes("skein::run_p2l", run, SourcesToTargets<Space, Real, Field>{passes});
  for (int level = first_far_level + 1; level < n_levels; ++level)
    workers.for_boxes("skein::run_l2l", at(boxes.targets, level), ParentsToChildren<Space, Real, Field>{passes});
}

}  // namespace skein
