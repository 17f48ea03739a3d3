#pragma once

#include <skein/ranks/communicator.hpp>

namespace skein::perf {

/// Prints what sums take of which each rank has its own nodes and a part of the tree, anywhere in a cube: seconds, and
/// memory by what the system gave to the process. To be called by all ranks.
/// @param n_nodes  of all ranks  @param ranks  null: one process, which has the whole tree
void measure_parts(int n_nodes, Communicator* ranks, int repeats);

}  // namespace skein::perf
