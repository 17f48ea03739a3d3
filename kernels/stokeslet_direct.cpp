#include "kernels/stokeslet_direct.hpp"

#include <skein/arrays/launch.hpp>
#include <skein/core/error.hpp>

#include "kernels/stokeslet_block.hpp"

#include <utility>

namespace skein {
namespace {

template <class Real>
void add_by_blocks(const HostSpace& space, const HostSources& sources, const ConstVectorView<HostSpace>& target,
                   const VectorView<HostSpace>& velocity) {
  const int n_sources = sources.position.extent_int(0);
  const int n_targets = target.extent_int(0);
  const Calls blocks{math::ceil_div(n_targets, block_targets), 1.0 * block_targets * n_sources};
  launch<HostSpace, Kokkos::Schedule<Kokkos::Dynamic>>(
      "skein::add_stokeslet_velocity", space, blocks, [=](const int block) {
        const int first = block * block_targets;
        bool given = false;
        const auto all_sources = [&](IndexRange& run) {
          run = {0, n_sources};
          return !std::exchange(given, true);
        };
        add_runs_to_targets<Real>(sources, all_sources, target,
                                  {first, math::smaller(block_targets, n_targets - first)}, velocity);
      });
}

}  // namespace

void add_stokeslet_velocity(const HostSpace& space, const ConstVectorView<HostSpace>& source_position,
                            const ConstVectorView<HostSpace>& source_force, const ConstScalarView<HostSpace>& blob,
                            const ConstVectorView<HostSpace>& target, const VectorView<HostSpace>& velocity,
                            const double viscosity, const Precision precision) {
  SKEIN_REQUIRE(source_position.extent(0) == source_force.extent(0) && source_position.extent(0) == blob.extent(0),
                "positions, forces and blobs of the sources differ in number");
  SKEIN_REQUIRE(target.extent(0) == velocity.extent(0), "targets and velocities differ in number");
  if (source_position.extent(0) == 0 || target.extent(0) == 0) return;
  const HostSources sources{source_position, source_force, blob, regularized_stokeslet::scale(viscosity)};
  with_precision(precision, [&](auto number) { add_by_blocks<decltype(number)>(space, sources, target, velocity); });
}

}  // namespace skein
