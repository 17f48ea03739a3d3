#include "mpi/mpi_checks.hpp"

#include <skein/ranks/rank_error.hpp>

#include <fmt/format.h>
#include <mpi.h>

#include <climits>

namespace skein {

void check_mpi(const int status, const char* const function) {
  if (status == MPI_SUCCESS) return;
  char text[MPI_MAX_ERROR_STRING] = "";
  int length = 0;
  MPI_Error_string(status, text, &length);
  throw RankError(ExitCode::io_error, fmt::format("ranks cannot reach each other ({}): {}", function, text));
}

int to_int(const std::size_t number) {
  SKEIN_REQUIRE(number <= static_cast<std::size_t>(INT_MAX), "more numbers than MPI counts in one message");
  return static_cast<int>(number);
}

}  // namespace skein
