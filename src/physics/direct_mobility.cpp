#include <skein/core/error.hpp>
#include <skein/fmm/machine_rates.hpp>
#include <skein/physics/direct_mobility.hpp>
#include <skein/physics/mobility_choice.hpp>
#include <skein/physics/sum_team.hpp>

#include "direct_sums.hpp"
#include "kernels/node_checks.hpp"
#include "kernels/stokeslet_direct.hpp"
#include "kernels/stokeslet_teams.hpp"

#include <algorithm>

namespace skein {
namespace {

/// Threads of the device that a host stands for in tests, so that results do not depend on those it has.
constexpr int host_stands_for = 4096;

/// Templates, so that a GPU build compiles no call of the host's kernels.
template <class Space>
void add_on_host(const Space& space, const Sources& sources, const ConstVectors& target, const Vectors& velocity,
                 const double viscosity, const Precision precision) {
  if constexpr (!on_host<Space>)
    throw Error(ExitCode::internal, "arrays of a device are not summed on the host");
  else
    add_stokeslet_velocity(space, sources.position, sources.force, sources.blob, target, velocity, viscosity,
                           precision);
}
template <class Space>
void add_symmetric_on_host(const Space& space, const Sources& sources, const Vectors& velocity, const double viscosity,
                           const Precision precision) {
  if constexpr (on_host<Space>)
    add_symmetric_stokeslet_velocity(space, sources.position, sources.force, sources.blob, velocity, viscosity,
                                     precision);
}

}  // namespace

bool weighs_pairs_once(const Sources& sources, const ConstVectors& target) {
  if (!on_host<ExecSpace> || !are_same_nodes(sources.position, target) || target.extent_int(0) < min_symmetric_nodes)
    return false;
  const double* blob = sources.blob.data();
  return std::all_of(blob, blob + sources.blob.extent(0), [=](const double value) { return value == *blob; });
}

void add_general_velocity(const Sources& sources, const ConstVectors& target, const int n_targets_in_all,
                          const Vectors& velocity, const double viscosity, const Precision precision,
                          const bool by_teams, Scalars& partial) {
  const ExecSpace space;
  if (!by_teams) return add_on_host(space, sources, target, velocity, viscosity, precision);
  const TeamSplit split = choose_team_split(on_host<ExecSpace> ? host_stands_for : space.concurrency(),
                                            sources.position.extent_int(0), n_targets_in_all);
  add_stokeslet_velocity_by_teams<ExecSpace>(space, sources.position, sources.force, sources.blob, target, velocity,
                                             viscosity, precision, split, partial);
}

DirectMobility::DirectMobility(const double viscosity, const Precision precision, const KernelPath path, SumTeam* team)
    : viscosity_(viscosity),
      precision_(precision == Precision::automatic ? Precision::in_double : precision),
      by_teams_(path == KernelPath::device || !on_host<ExecSpace>),
      team_(team) {
  SKEIN_REQUIRE(viscosity > 0.0, "the viscosity must be positive");
}

void DirectMobility::add_velocity(const Sources& sources, const ConstVectors& target, const Vectors& velocity) {
  pairs_ += static_cast<double>(sources.position.extent(0)) * static_cast<double>(target.extent(0));
  if (team_ != nullptr) return team_->add_direct(sources, target, velocity, viscosity_, precision_, by_teams_);
  if (!by_teams_ && weighs_pairs_once(sources, target))
    return add_symmetric_on_host(ExecSpace(), sources, velocity, viscosity_, precision_);
  add_general_velocity(sources, target, target.extent_int(0), velocity, viscosity_, precision_, by_teams_, partial_);
}

double DirectMobility::relative_cost(const NodeLines& nodes) const {
  const MachineRates& rates = machine_rates(by_teams_ ? KernelPath::device : KernelPath::host);
  const double n_pairs = nodes.n_nodes * nodes.n_nodes;
  return precision_ == Precision::in_single && n_pairs > 0.0
             ? rates.direct_nanoseconds(true, true, n_pairs) / rates.direct_nanoseconds(true, false, n_pairs)
             : 1.0;
}

std::string DirectMobility::describe() const { return describe_direct_sum(precision_); }

}  // namespace skein
