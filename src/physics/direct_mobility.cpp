#include <skein/core/error.hpp>
#include <skein/physics/direct_mobility.hpp>
#include <skein/physics/mobility_choice.hpp>

#include "kernels/node_checks.hpp"
#include "kernels/stokeslet_direct.hpp"
#include "kernels/stokeslet_teams.hpp"

#include <algorithm>

namespace skein {
namespace {

/// Threads of the device that a host stands for in tests, so that results do not depend on those it has.
constexpr int host_stands_for = 4096;

/// True where each pair can be weighed once for both of its nodes: nodes that are sources and targets, with equal
/// blobs. Looked up at every call: n comparisons beside n^2 pairs, and nothing to go stale when the caller changes an
/// array.
[[maybe_unused]] bool is_symmetric(const Sources& sources, const ConstVectors& target) {
  if (!are_same_nodes(sources.position, target) || target.extent_int(0) < min_symmetric_nodes) return false;
  const double* blob = sources.blob.data();
  return std::all_of(blob, blob + sources.blob.extent(0), [=](const double value) { return value == *blob; });
}

/// By the processor's vector units, each pair once where that is possible. A template, so that a GPU build compiles no
/// call of the host's kernels.
template <class Space>
void add_on_host(const Space& space, const Sources& sources, const ConstVectors& target, const Vectors& velocity,
                 const double viscosity, const Precision precision) {
  if constexpr (!on_host<Space>) {
    throw Error(ExitCode::internal, "arrays of a device are not summed on the host");
  } else if (is_symmetric(sources, target)) {
    add_symmetric_stokeslet_velocity(space, sources.position, sources.force, sources.blob, velocity, viscosity,
                                     precision);
  } else {
    add_stokeslet_velocity(space, sources.position, sources.force, sources.blob, target, velocity, viscosity,
                           precision);
  }
}

}  // namespace

DirectMobility::DirectMobility(const double viscosity, const Precision precision, const KernelPath path)
    : viscosity_(viscosity),
      precision_(precision == Precision::automatic ? Precision::in_double : precision),
      by_teams_(path == KernelPath::device || !on_host<ExecSpace>) {
  SKEIN_REQUIRE(viscosity > 0.0, "the viscosity must be positive");
}

void DirectMobility::add_velocity(const Sources& sources, const ConstVectors& target, const Vectors& velocity) {
  pairs_ += static_cast<double>(sources.position.extent(0)) * static_cast<double>(target.extent(0));
  const ExecSpace space;
  if (!by_teams_) return add_on_host(space, sources, target, velocity, viscosity_, precision_);
  const TeamSplit split = choose_team_split(on_host<ExecSpace> ? host_stands_for : space.concurrency(),
                                            sources.position.extent_int(0), target.extent_int(0));
  add_stokeslet_velocity_by_teams<ExecSpace>(space, sources.position, sources.force, sources.blob, target, velocity,
                                             viscosity_, precision_, split, partial_);
}

std::string DirectMobility::describe() const { return describe_direct_sum(precision_); }

}  // namespace skein
