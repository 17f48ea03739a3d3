#include "kernels/flow_velocity.hpp"

#include <skein/core/error.hpp>
#include <skein/core/math.hpp>

namespace skein {
namespace {

constexpr double pi = 3.14159265358979323846;

KOKKOS_INLINE_FUNCTION Vec3 velocity_of(const FlowTerm& term, const Vec3 position) {
  const Vec3 d = position - term.origin;
  switch (term.shape) {
    case FlowShape::linear:
      return {dot(term.gradient_x, d), dot(term.gradient_y, d), dot(term.gradient_z, d)};
    case FlowShape::parabolic: {
      const double height = d.y / term.size;
      return {0.5 * term.rate * term.size * (1.0 - height * height), 0.0, 0.0};
    }
    case FlowShape::cellular: {
      const double k = pi / term.size;
      const double speed = term.rate / k;
      return {speed * math::sin(k * d.x) * math::cos(k * d.y), -speed * math::cos(k * d.x) * math::sin(k * d.y), 0.0};
    }
  }
  return {};
}

}  // namespace

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
