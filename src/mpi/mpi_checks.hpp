#pragma once

#include <cstddef>

namespace skein {

/// @param status  what a function of MPI has returned  @throws RankError where it is no success
void check_mpi(int status, const char* function);

/// A number of numbers as MPI counts them. @throws Error(internal) where it does not count so far
int to_int(std::size_t number);

}  // namespace skein
