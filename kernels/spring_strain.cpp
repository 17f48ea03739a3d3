#include "kernels/spring_strain.hpp"

#include <skein/arrays/launch.hpp>
#include <skein/core/error.hpp>

#include "kernels/spring_node.hpp"

namespace skein {

template <class Space>
double compute_largest_strain(const Space& space, const SpringArrays<Space>& springs,
                              const ConstVectorView<Space>& position) {
  SKEIN_REQUIRE(position.extent(0) == springs.fiber_of_node.extent(0),
                "positions and the nodes of the springs differ in number");
  double largest = 0.0;
  launch_reduction<Space>(
      "skein::compute_largest_strain", space, Calls{position.extent_int(0), 100.0},
      KOKKOS_LAMBDA(const int node, double& found) {
        const Vec3 x = load(position, node);
        for_each_spring<Space>(springs, node, [&](const int other, const double, const double inverse_rest_length) {
          const double strain = norm(x - load(position, other)) * inverse_rest_length - 1.0;
          const double size = strain < 0.0 ? -strain : strain;
          if (size > found) found = size;
        });
      },
      Kokkos::Max<double>(largest));
  return largest > 0.0 ? largest : 0.0;  // of no nodes, the reduction's smallest number
}

#define SKEIN_INSTANTIATE(S) \
  template double compute_largest_strain<S>(const S&, const SpringArrays<S>&, const ConstVectorView<S>&);
SKEIN_FOR_EACH_EXEC_SPACE(SKEIN_INSTANTIATE)

}  // namespace skein
