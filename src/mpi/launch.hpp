#pragma once

#include <skein/ranks/communicator.hpp>

#include <string>

namespace skein {

/// What a launcher of MPI programs (mpirun, srun with PMI or PMIx) says in the environment of the processes it starts.
struct Launch {
  int size = 0;  ///< 0: there was none, the program was started by itself; 1 where the launcher does not say how many
  int rank = 0;
  int n_on_machine = 1;  ///< as far as the launcher says; else as if each rank had a machine of its own
};
Launch find_launch();

/// The ranks that this process was started with, joined at the first call; null where it was started by itself, which
/// begins nothing of MPI. @throws Error(usage) where a launcher has started several and this program is built without
/// MPI; Error(io_error) where MPI does not begin
Communicator* join_ranks();

/// At the end of the program, after all messages, with its exit code: ends the ranks that were joined, by force where
/// they are no longer in step. @returns the exit code
int leave_ranks(int exit_code);

/// "Open MPI 4.1.4", or that there is none.
std::string describe_mpi();

/// Threads for this rank where nothing says how many: the processors of the machine are shared by its ranks.
/// @param asked  by --threads; 0: nothing  @returns `asked`, or a number where neither it nor the environment says one
int share_threads(int asked);

}  // namespace skein
