#pragma once

#include "fmm/blob_tail.hpp"
#include "fmm/box_sums.hpp"
#include "fmm/fmm_operator_set.hpp"
#include "fmm/passes.hpp"

namespace skein {

/// Velocities at some targets of a leaf that come from expansions: its own, and those of its W list. A part offers
/// add_surface(operators, to_density, coefficients, size of the surface, box) and, for the tails of blobs,
/// add_polynomials(coefficients, box).
template <class Part, class Space, class Real, class Field>
SKEIN_FORMULA void add_expansions(Part& part, const Passes<Space, Real, Field>& passes, const int leaf) {
  const int b = passes.target_leaves(leaf);
  const Box& box = passes.boxes(b);
  if (box.level >= first_far_level) {
    const LevelOperators<Real>& operators = passes.operators_of(box);
    if constexpr (std::is_same_v<Field, TailField>)
      part.add_polynomials(passes.target_of(b), box);
    else
      part.add_surface(operators, operators.target_density, passes.target_of(b), static_cast<Real>(outer_surface), box);
  }
  for (int k = passes.w_list.first(leaf); k < passes.w_list.first(leaf + 1); ++k) {
    const int w = passes.w_list.entries(k);
    const Box& fine = passes.boxes(w);
    const LevelOperators<Real>& operators = passes.operators_of(fine);
    part.add_surface(operators, operators.source_density, passes.source_of(w), static_cast<Real>(inner_surface), fine);
  }
}

}  // namespace skein
