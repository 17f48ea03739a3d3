#pragma once

#include <skein/ranks/communicator.hpp>

#include <functional>
#include <string>

namespace skein {

class SumTeam;

/// What one process does of a run, or of all that a verb does with one: rank 0, or a process without ranks, calls
/// `lead` with its ranks or null, the others serve its sums until it returns or throws. Needs no Kokkos: each side
/// begins it.
/// @param threads  of this process, for the others; see Runtime
/// @returns what `lead` returns, on all ranks
int share_run(Communicator* ranks, int threads, const std::function<int(Communicator* ranks)>& lead);

/// Lines for the first and the last words of a run: how many ranks and threads, how sums are divided, how evenly.
std::string describe_ranks(SumTeam& team);

}  // namespace skein
