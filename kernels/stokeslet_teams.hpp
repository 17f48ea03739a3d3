#pragma once

#include <skein/arrays/types.hpp>
#include <skein/core/precision.hpp>

namespace skein {

/// How a sum is cut up for teams of threads.
struct TeamSplit {
  int n_runs = 1;     ///< of sources, each summed by teams of its own
  int team_size = 0;  ///< threads; 0: what GPUs like, and 1 on a host
};

/// By arithmetic alone, so that a device repeats its sums to the bit: about twice as many threads as it runs at once,
/// so that none of it idles for long at the end, but no runs too short to be worth a team.
/// @param concurrency  threads that the device runs at once
TeamSplit choose_team_split(int concurrency, int n_sources, int n_targets);

/// velocity += sum over sources of the regularized Stokeslet, as GPUs compute it: a team holds targets, shares tiles of
/// a run of sources, and writes partial sums, which are added in the order of the runs. Hosts have it so that it is
/// tested everywhere; they use it for nothing else.
///
/// @param source_position, source_force  [n_sources, 3];  @param blob  [n_sources], > 0
/// @param target, velocity               [n_targets, 3]
/// @param precision  of a pair, not automatic. Single: coordinates are floats from the middle of a tile, with what they
///                   miss where that matters (see NodeTile); sums are double beyond a tile. About 3e-7
/// @param split    the result depends on its number of runs, not on the size of teams
/// @param partial  scratch; grows where it is too small
template <class Space>
void add_stokeslet_velocity_by_teams(const Space& space, const ConstVectorView<Space>& source_position,
                                     const ConstVectorView<Space>& source_force, const ConstScalarView<Space>& blob,
                                     const ConstVectorView<Space>& target, const VectorView<Space>& velocity,
                                     double viscosity, Precision precision, const TeamSplit& split,
                                     ScalarView<Space>& partial);

}  // namespace skein
