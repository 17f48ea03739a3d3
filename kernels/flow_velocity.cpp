#include "kernels/flow_velocity.hpp"

#include <skein/arrays/launch.hpp>
#include <skein/core/error.hpp>

namespace skein {
namespace {

/// @tparam capacity  terms that travel with the kernel. One is the rule, and four are so many bytes that Kokkos sends
/// them
///                   to a GPU apart, where a launch waits for the one before.
template <class Space, int capacity>
struct FlowSum {
  FlowTerm term[capacity];
  int n_terms;
  ConstVectorView<Space> position;
  VectorView<Space> velocity;
  bool adds;

  KOKKOS_INLINE_FUNCTION void operator()(const int i) const {
    const Vec3 x = load(position, i);
    Vec3 sum = adds ? load(velocity, i) : Vec3{};
    for (int t = 0; t < n_terms; ++t) sum = sum + velocity_of(term[t], x);
    store(velocity, i, sum);
  }
};

template <int capacity, class Space>
void launch_sum(const Space& space, const FlowTerms& terms, const ConstVectorView<Space>& position,
                const VectorView<Space>& velocity, const bool adds) {
  FlowSum<Space, capacity> sum{{}, terms.n_terms, position, velocity, adds};
  for (int t = 0; t < terms.n_terms; ++t) sum.term[t] = terms.term[t];
  launch<Space>("skein::add_flow_velocity", space, Calls{position.extent_int(0), 10.0}, sum);
}

template <class Space>
void sum_up(const Space& space, const FlowTerms& terms, const ConstVectorView<Space>& position,
            const VectorView<Space>& velocity, const bool adds) {
  SKEIN_REQUIRE(position.extent(0) == velocity.extent(0), "positions and velocities differ in number");
  if (terms.n_terms <= 1)
    launch_sum<1, Space>(space, terms, position, velocity, adds);
  else
    launch_sum<FlowTerms::n_allowed, Space>(space, terms, position, velocity, adds);
}

}  // namespace

template <class Space>
void add_flow_velocity(const Space& space, const FlowTerms& terms, const ConstVectorView<Space>& position,
                       const VectorView<Space>& velocity) {
  sum_up<Space>(space, terms, position, velocity, true);
}

template <class Space>
void compute_flow_velocity(const Space& space, const FlowTerms& terms, const ConstVectorView<Space>& position,
                           const VectorView<Space>& velocity) {
  sum_up<Space>(space, terms, position, velocity, false);
}

#define SKEIN_INSTANTIATE(S)                                                                                       \
  template void add_flow_velocity<S>(const S&, const FlowTerms&, const ConstVectorView<S>&, const VectorView<S>&); \
  template void compute_flow_velocity<S>(const S&, const FlowTerms&, const ConstVectorView<S>&, const VectorView<S>&);
SKEIN_FOR_EACH_EXEC_SPACE(SKEIN_INSTANTIATE)

}  // namespace skein
