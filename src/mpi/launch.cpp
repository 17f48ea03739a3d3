#include "mpi/launch.hpp"

#include <sched.h>
#include <unistd.h>

#include <algorithm>
#include <charconv>
#include <cstdlib>
#include <string_view>

namespace skein {
namespace {

/// -1: the variable is not there, or is no number.
int read_number(const char* variable) {
  const char* text = std::getenv(variable);
  if (text == nullptr) return -1;
  const std::string_view digits(text);
  int number = -1;
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), number);
  return error == std::errc() && end == digits.data() + digits.size() ? number : -1;
}

bool is_set(const char* variable) {
  const char* text = std::getenv(variable);
  return text != nullptr && *text != '\0';
}

}  // namespace

// Slurm's own variables are not asked: a script of sbatch has them, too, in which no rank was started.
Launch find_launch() {
  Launch launch;
  launch.size = std::max(read_number("OMPI_COMM_WORLD_SIZE"), read_number("PMI_SIZE"));
  launch.rank = std::max({0, read_number("OMPI_COMM_WORLD_RANK"), read_number("PMI_RANK"), read_number("PMIX_RANK")});
  if (launch.size <= 0) launch.size = is_set("PMIX_RANK") || is_set("PMI_RANK") ? 1 : 0;
  launch.n_on_machine = std::max({1, read_number("OMPI_COMM_WORLD_LOCAL_SIZE"), read_number("MPI_LOCALNRANKS")});
  return launch;
}

int share_threads(const int asked) {
  if (asked > 0 || is_set("KOKKOS_NUM_THREADS") || is_set("OMP_NUM_THREADS")) return asked;
  const int n_on_machine = find_launch().n_on_machine;
  if (n_on_machine == 1) return asked;
  const int n_processors = static_cast<int>(sysconf(_SC_NPROCESSORS_ONLN));
  cpu_set_t allowed;  // fewer where the launcher binds its ranks
  const int n_allowed = sched_getaffinity(0, sizeof allowed, &allowed) == 0 ? CPU_COUNT(&allowed) : n_processors;
  return std::clamp(n_processors / n_on_machine, 1, std::max(1, n_allowed));
}

}  // namespace skein
