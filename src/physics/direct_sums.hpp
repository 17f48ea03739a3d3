#pragma once

#include <skein/arrays/sources.hpp>
#include <skein/arrays/types.hpp>
#include <skein/core/precision.hpp>

namespace skein {

/// True where each pair can be weighed once for both of its nodes, on the host: nodes that are sources and targets,
/// with equal blobs. Looked up at every call: n comparisons beside n^2 pairs, and nothing to go stale when the caller
/// changes an array.
bool weighs_pairs_once(const Sources& sources, const ConstVectors& target);

/// velocity += the sum over all sources at some targets, each pair from one side: by the host's vector units, or as
/// devices do it.
/// @param n_targets_in_all  of which these are a part: the order of a device's sum follows from them
/// @param partial           scratch of the teams
void add_general_velocity(const Sources& sources, const ConstVectors& target, int n_targets_in_all,
                          const Vectors& velocity, double viscosity, Precision precision, bool by_teams,
                          Scalars& partial);

}  // namespace skein
