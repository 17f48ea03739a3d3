#pragma once

#include <skein/arrays/types.hpp>
#include <skein/core/precision.hpp>

#include "kernels/pair_rounds.hpp"

#include <vector>

namespace skein {

/// velocity += sum over sources of the regularized Stokeslet, on the host; blobs belong to the sources. What GPUs do
/// instead is in stokeslet_teams.hpp.
///
/// @param source_position, source_force  [n_sources, 3];  @param blob  [n_sources], > 0
/// @param target, velocity               [n_targets, 3]
/// @param precision  arithmetic of one pair, not automatic. Single: differences keep double accuracy, sums are double
///                   beyond a tile; the result is good to about 1e-6.
///
/// The order of every sum is fixed by the tiles alone: the result does not depend on threads.
void add_stokeslet_velocity(const HostSpace& space, const ConstVectorView<HostSpace>& source_position,
                            const ConstVectorView<HostSpace>& source_force, const ConstScalarView<HostSpace>& blob,
                            const ConstVectorView<HostSpace>& target, const VectorView<HostSpace>& velocity,
                            double viscosity, Precision precision);

/// The general sum where every source is a target and all blobs are equal, on the host: S_eps is symmetric then, and
/// each pair is weighed once for both of its nodes. perf/bench_direct compares it with the general sum.
/// @param blob  [n_nodes], all equal (not checked); at least min_symmetric_nodes nodes.
void add_symmetric_stokeslet_velocity(const HostSpace& space, const ConstVectorView<HostSpace>& position,
                                      const ConstVectorView<HostSpace>& force, const ConstScalarView<HostSpace>& blob,
                                      const VectorView<HostSpace>& velocity, double viscosity, Precision precision);

/// The part of that sum which a block of rounds contributes, for processes that share it: overwrites the velocities of
/// all nodes. Blocks are added up along their tree, so that the whole sum depends on nothing but the nodes.
/// @param scratch  arrays as long as `velocity`; grows where it holds too few
void compute_round_velocity(const HostSpace& space, const ConstVectorView<HostSpace>& position,
                            const ConstVectorView<HostSpace>& force, const ConstScalarView<HostSpace>& blob,
                            const PairRounds& rounds, const RoundBlock& block, const VectorView<HostSpace>& velocity,
                            double viscosity, Precision precision, std::vector<HostVectors>& scratch);

/// Below this many nodes the symmetric sum has too few tiles to keep threads busy.
inline constexpr int min_symmetric_nodes = 256;

}  // namespace skein
