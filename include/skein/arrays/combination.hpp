#pragma once

#include <skein/arrays/types.hpp>

#include <cmath>
#include <vector>

namespace skein {

/// One term of a linear combination of arrays [n, 3].
template <class Space>
struct Term {
  double factor = 0.0;
  ConstVectorView<Space> vectors;
};

/// result = sum of terms, added in the order given. `result` may be one of the terms.
template <class Space>
void combine(const Space& space, const VectorView<Space>& result, const Term<Space>& a, const Term<Space>& b);
template <class Space>
void combine(const Space& space, const VectorView<Space>& result, const Term<Space>& a, const Term<Space>& b,
             const Term<Space>& c, const Term<Space>& d);
template <class Space>
void combine(const Space& space, const VectorView<Space>& result, const Term<Space>& a, const Term<Space>& b,
             const Term<Space>& c, const Term<Space>& d, const Term<Space>& e);

/// a . b over all components; the order of the sum does not depend on threads. Waits for the device.
template <class Space>
double dot_product(const Space& space, const ConstVectorView<Space>& a, const ConstVectorView<Space>& b);

/// Nodes that are added up by themselves in a dot product of so many: what fixes its order.
template <class Space>
int choose_dot_chunk(int n_nodes);

/// What a dot product adds up in the end: its parts from chunks of nodes, of which the last may have fewer.
template <class Space>
std::vector<double> dot_chunks(const Space& space, const ConstVectorView<Space>& a, const ConstVectorView<Space>& b,
                               int chunk_nodes);

/// Over nodes, of the vectors' lengths; the order of the sum is that of dot_product.
template <class Space>
double root_mean_square(const Space& space, const ConstVectorView<Space>& vectors) {
  return std::sqrt(dot_product<Space>(space, vectors, vectors) / static_cast<double>(vectors.extent(0)));
}

}  // namespace skein
