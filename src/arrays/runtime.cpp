#include <skein/arrays/default_path.hpp>
#include <skein/arrays/runtime.hpp>
#include <skein/arrays/types.hpp>
#include <skein/core/error.hpp>
#include <skein/core/version.hpp>

#include "host_threads.hpp"

#include <fmt/format.h>

#include <exception>

namespace skein {
namespace {

std::string compiler() {
#if defined(__CUDACC__)
  return fmt::format("nvcc {}.{}", __CUDACC_VER_MAJOR__, __CUDACC_VER_MINOR__);
#elif defined(__clang__)
  return fmt::format("clang {}.{}.{}", __clang_major__, __clang_minor__, __clang_patchlevel__);
#elif defined(__GNUC__)
  return fmt::format("g++ {}.{}.{}", __GNUC__, __GNUC_MINOR__, __GNUC_PATCHLEVEL__);
#else
  return "unknown";
#endif
}

std::string name_host_threads() {
#if defined(KOKKOS_ENABLE_OPENMP)
  return fmt::format("{} with {} threads", HostSpace::name(), HostSpace().concurrency());
#else
  return HostSpace::name();
#endif
}

HostThreads& last_choice() {
  static HostThreads choice;
  return choice;
}

}  // namespace

const HostThreads& host_threads() { return last_choice(); }

Runtime::Runtime(const int threads, const int useful) {
  HostThreads& chosen = last_choice();
  chosen = choose_host_threads(threads, useful);
  const int n_threads = have_host_threads ? chosen.number : 0;
  try {
    initialize_kokkos(n_threads);
  } catch (const std::exception& error) {
    throw Error(
        ExitCode::usage,
        fmt::format("Kokkos does not begin: {}\nLook at the variables KOKKOS_* of the environment.", error.what()));
  }
}
Runtime::~Runtime() { Kokkos::finalize(); }

KernelPath default_path() { return on_host<ExecSpace> ? KernelPath::host : KernelPath::device; }

std::string describe_backend() {
  if constexpr (on_host<ExecSpace>) return name_host_threads();
  return fmt::format("{}, host {}", ExecSpace::name(), name_host_threads());
}

std::string describe_build() {
  return fmt::format(
      "skein: {}\ncommit: {}\nbuild: {}\ncompiler: {}\nKokkos: {}.{}.{}\nbackend: {}\nhost backend: {}\n", version(),
      commit(), build_type(), compiler(), KOKKOS_VERSION / 10000, KOKKOS_VERSION / 100 % 100, KOKKOS_VERSION % 100,
      ExecSpace::name(), HostSpace::name());
}

}  // namespace skein
