#include "kernels/flow_velocity.hpp"

#include <skein/core/error.hpp>

namespace skein {
template <class Space>
void add_flow_velocity(const Space& space, const FlowTerms& terms, const ConstVectorView<Space>& position,
                       const VectorView<Space>& velocity) {
  SKEIN_REQUIRE(position.extent(0) == velocity.extent(0), "positions and velocities differ in number");
  Kokkos::parallel_for(
      "skein::add_flow_velocity", Kokkos::RangePolicy<Space>(space, 0, position.extent_int(0)),
      KOKKOS_LAMBDA(const int i) {
        const Vec3 x = load(position, i);
        Vec3 sum = load(velocity, i);
        for (int t = 0; t < terms.n_terms; ++t) sum = sum + velocity_of(terms.term[t], x);
        store(velocity, i, sum);
      });
}

#define SKEIN_INSTANTIATE(S) \
  template void add_flow_velocity<S>(const S&, const FlowTerms&, const ConstVectorView<S>&, const VectorView<S>&);
SKEIN_FOR_EACH_EXEC_SPACE(SKEIN_INSTANTIATE)

}  // namespace skein
