#pragma once

#include "fmm/passes.hpp"
#include "fmm/tree_tasks.hpp"

#include <span>

namespace skein {

inline constexpr int host_part_targets = 256;

/// The near field of the leaves' targets: what is there already, and what is still to be summed.
struct NearField {
  const IndexRange* runs = nullptr;  ///< of sources, per target leaf runs[first[leaf]] .. runs[end[leaf] - 1]
  const int* first = nullptr;
  const int* end = nullptr;
  HostScalars velocity;  ///< [3][n_packed] in the packed order of NearMatches, or empty
  int n_packed = 0;
  const int* leaf_first = nullptr;  ///< per target leaf its first place in the packed order

  std::span<const IndexRange> of_leaf(const int leaf) const { return {runs + first[leaf], runs + end[leaf]}; }
};

/// velocity(original index) = near field + far field of the coefficients, leaf by leaf; the tail of the blobs is added
/// to what is there.
template <class Near, class Real, class Field>
void sum_leaf_velocities(const Passes<HostSpace, Real, Field>& passes, const NearField& near,
                         const LeafParts<HostSpace>& parts, const HostVectors& velocity);

}  // namespace skein
