#pragma once

#include <skein/arrays/types.hpp>

#include "kernels/spring_force.hpp"

namespace skein {

/// The largest |r/l - 1| over all springs, r their length and l that at rest; 0 without springs.
template <class Space>
double compute_largest_strain(const Space& space, const SpringArrays<Space>& springs,
                              const ConstVectorView<Space>& position);

}  // namespace skein
