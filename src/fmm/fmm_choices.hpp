#pragma once

#include <skein/core/error.hpp>
#include <skein/core/stopwatch.hpp>
#include <skein/fmm/fmm_plan.hpp>
#include <skein/fmm/fmm_sum.hpp>

#include "fmm/laplace.hpp"
#include "fmm/octree_cube.hpp"
#include "kernels/node_checks.hpp"

#include <chrono>
#include <memory>
#include <type_traits>
#include <utility>
#include <vector>

namespace skein {

/// Seconds since the lap before.
class LapTimer {
 public:
  double lap() {
    const auto since = std::exchange(start_, WallClock::now());
    return std::chrono::duration<double>(start_ - since).count();
  }

 private:
  WallClock::time_point start_ = WallClock::now();
};

OctreeRules make_octree_rules(const FmmOptions& options, const FmmPlan& plan);

/// Half-widths in a tree, length.
struct LeafRange {
  double smallest, largest;
};

/// What the plan leaves to the tree: where no leaf is so small that the blobs' term of eps^4 matters, it is left out.
/// @throws Error(scene_error) where the far field needs one blob and there are several
void settle_plan(const FmmOptions& options, BlobRange blobs, LeafRange leaves, FmmPlan& plan);

/// use(field) with the far field of the options. @param blob  of all sources, where the far field depends on it
template <class Use>
void with_far_field(const FmmOptions& options, const double blob, const Use& use) {
  switch (options.far_field) {
    case FarField::harmonic:
      use(HarmonicField{});
      return;
    case FarField::stokeslet:
      use(StokesletField{options.stokes_part_only});
      return;
    case FarField::regularized:
      use(RegularizedField{blob * blob});
      return;
  }
  throw Error(ExitCode::internal, "with_far_field knows no such far field");
}

/// use(Near{}) with the precision of the near field: never single beside a far field in double.
template <class Far, class Use>
void with_near_precision(const FmmPlan& plan, const Use& use) {
  if constexpr (std::is_same_v<Far, float>) {
    if (plan.near_in_single) return use(float{});
  }
  use(double{});
}

}  // namespace skein
