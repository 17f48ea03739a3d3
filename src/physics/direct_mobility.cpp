#include <skein/core/error.hpp>
#include <skein/physics/direct_mobility.hpp>
#include <skein/physics/mobility_choice.hpp>

#include "kernels/node_checks.hpp"
#include "kernels/stokeslet_direct.hpp"

#include <algorithm>

namespace skein {
namespace {

/// True where each pair can be weighed once for both of its nodes: nodes that are sources and targets, with equal
/// blobs. Looked up at every call: n comparisons beside n^2 pairs, and nothing to go stale when the caller changes an
/// array.
[[maybe_unused]] bool is_symmetric(const Sources& sources, const ConstVectors& target) {
  if (!are_same_nodes(sources.position, target) || target.extent_int(0) < min_symmetric_nodes) return false;
  const double* blob = sources.blob.data();
  return std::all_of(blob, blob + sources.blob.extent(0), [=](const double value) { return value == *blob; });
}

/// Takes the symmetric sum where it is possible. A template, so that a GPU build compiles no call of the host's kernel.
template <class Space>
bool try_symmetric_sum(const Space& space, const Sources& sources, const ConstVectors& target, const Vectors& velocity,
                       const double viscosity, const Precision precision) {
  if constexpr (on_host<Space>) {
    if (!is_symmetric(sources, target)) return false;
    add_symmetric_stokeslet_velocity(space, sources.position, sources.force, sources.blob, velocity, viscosity,
                                     precision);
    return true;
  } else {
    return false;
  }
}

}  // namespace

DirectMobility::DirectMobility(const double viscosity, const Precision precision)
    : viscosity_(viscosity), precision_(precision == Precision::automatic ? Precision::in_double : precision) {
  SKEIN_REQUIRE(viscosity > 0.0, "the viscosity must be positive");
}

void DirectMobility::add_velocity(const Sources& sources, const ConstVectors& target, const Vectors& velocity) {
  pairs_ += static_cast<double>(sources.position.extent(0)) * static_cast<double>(target.extent(0));
  const ExecSpace space;
  if (try_symmetric_sum(space, sources, target, velocity, viscosity_, precision_)) return;
  add_stokeslet_velocity<ExecSpace>(space, sources.position, sources.force, sources.blob, target, velocity, viscosity_,
                                    precision_);
}

std::string DirectMobility::describe() const { return describe_direct_sum(precision_); }

}  // namespace skein
