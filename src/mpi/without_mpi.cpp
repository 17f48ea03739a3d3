#include <skein/core/error.hpp>

#include "mpi/launch.hpp"

#include <fmt/format.h>

#include <cstdlib>

namespace skein {

Communicator* join_ranks() {
  const Launch launch = find_launch();
  if (launch.size > 1 && launch.rank > 0) std::_Exit(static_cast<int>(ExitCode::usage));  // rank 0 says it for all
  if (launch.size > 1)
    throw Error(ExitCode::usage, fmt::format("{} ranks were started, but this skein is built without MPI: start it by "
                                             "itself, or build it with MPI (tools/setup.sh --with-mpi)",
                                             launch.size));
  return nullptr;
}

int leave_ranks(const int exit_code) { return exit_code; }

std::string describe_mpi() { return "none"; }

}  // namespace skein
