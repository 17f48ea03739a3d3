#include "host_threads.hpp"

#include <skein/arrays/runtime.hpp>
#include <skein/arrays/types.hpp>
#include <skein/core/error.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cstdlib>
#include <string>
#include <string_view>

#if defined(KOKKOS_ENABLE_OPENMP)
#include "thread_stacks.hpp"

#include <omp.h>
#endif

namespace skein {
namespace {

#if defined(KOKKOS_ENABLE_OPENMP)
void check_number(const int number, const std::string_view who, const std::string_view text) {
  if (number < 1 || number > most_host_threads)
    throw Error(ExitCode::usage, fmt::format("{}={}: a number of threads is 1 to {}", who, text, most_host_threads));
}

int read_number(const char* variable) {
  const char* text = std::getenv(variable);
  if (text == nullptr || *text == '\0') return 0;
  const std::string_view digits(text);
  int number = 0;
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), number);
  if (error != std::errc() || end != digits.data() + digits.size()) number = 0;
  check_number(number, variable, text);
  return number;
}

/// As many as were asked for; else as the OpenMP library would take, which has read OMP_NUM_THREADS, but no more than
/// are useful.
HostThreads find_number(const int asked, const int useful) {
  const int for_kokkos = read_number("KOKKOS_NUM_THREADS");
  const auto obey = [&](const int number, const char* who) { return HostThreads{number, useful, number, who}; };
  if (asked > 0) {
    check_number(asked, "--threads", std::to_string(asked));
    return obey(asked, "--threads");
  }
  if (for_kokkos > 0) return obey(for_kokkos, "KOKKOS_NUM_THREADS");
  const int by_library = omp_get_max_threads();
  const char* wanted = std::getenv("OMP_NUM_THREADS");
  if (wanted != nullptr && *wanted != '\0') {
    check_number(by_library, "OMP_NUM_THREADS", wanted);
    return obey(by_library, "OMP_NUM_THREADS");
  }
  const int possible = std::min(by_library, most_host_threads);  // of a machine with more processors
  return {std::clamp(useful, 1, possible), useful, possible, ""};
}

/// Kokkos relies on getting all of them.
void check_that_all_come(const int n_threads) {
  omp_set_dynamic(0);
  int n_come = 0;
#pragma omp parallel num_threads(n_threads) reduction(+ : n_come)
  ++n_come;
  if (n_come < n_threads)
    throw Error(
        ExitCode::usage,
        fmt::format("the environment's settings for OpenMP allow {} of {} threads: look at OMP_THREAD_LIMIT and "
                    "OMP_MAX_ACTIVE_LEVELS, or ask for fewer with --threads",
                    n_come, n_threads));
}
#endif

}  // namespace

int count_host_threads([[maybe_unused]] const int asked) {
#if defined(KOKKOS_ENABLE_OPENMP)
  return find_number(asked, most_host_threads).number;
#else
  return 1;
#endif
}

HostThreads choose_host_threads([[maybe_unused]] const int asked, [[maybe_unused]] const int useful) {
#if defined(KOKKOS_ENABLE_OPENMP)
  HostThreads chosen = find_number(asked, useful);
  check_thread_stacks(chosen.number);
  check_that_all_come(chosen.number);
  return chosen;
#else
  return {};
#endif
}

}  // namespace skein
