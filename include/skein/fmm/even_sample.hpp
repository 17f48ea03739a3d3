#pragma once

#include <skein/arrays/types.hpp>

#include <cstdint>
#include <vector>

namespace skein {

/// Some of n nodes, spread evenly over the indices.
struct EvenSample {
  int n = 0, n_chosen = 0;
  EvenSample(const int n_nodes, const int n_wanted) : n(n_nodes), n_chosen(math::smaller(n_nodes, n_wanted)) {}
  KOKKOS_INLINE_FUNCTION int index(const int i) const {
    return static_cast<int>((2 * static_cast<std::int64_t>(i) + 1) * n / (2 * n_chosen));
  }
};

/// The chosen vectors, on the host; the others stay where they are.
template <class Space>
std::vector<Vec3> read_sample(const Space& space, const ConstVectorView<Space>& vectors, const EvenSample& sample);

}  // namespace skein
