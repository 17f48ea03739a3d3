#include "thread_stacks.hpp"

#include <skein/core/error.hpp>
#include <skein/core/resource_error.hpp>

#include <fmt/format.h>
#include <pthread.h>
#include <sys/resource.h>

#include <cctype>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <mutex>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace skein {
namespace {

// Ten times what is needed: the fast multipole method ran with 100 KiB, and with 64 it did not.
constexpr double smallest_stack = 1 << 20;

/// "64k", "4 M", "65536" (KiB, where no unit is named), as OpenMP writes sizes of stacks.
std::optional<double> parse_size(const char* text) {
  char* end = nullptr;
  const double number = std::strtod(text, &end);
  if (end == text || !(number > 0.0)) return std::nullopt;
  std::string unit;
  for (; *end != '\0'; ++end)
    if (std::isspace(static_cast<unsigned char>(*end)) == 0)
      unit += static_cast<char>(std::tolower(static_cast<unsigned char>(*end)));
  constexpr std::pair<const char*, double> units[] = {
      {"b", 1.0}, {"", 1024.0}, {"k", 1024.0}, {"m", 1048576.0}, {"g", 1073741824.0}};
  for (const auto& [name, bytes] : units)
    if (unit == name) return number * bytes;
  return std::nullopt;  // the library ignores it, too
}

struct StackSize {
  double bytes;
  std::string source;  ///< in words
};

StackSize find_stack_size(const pthread_attr_t& attributes) {
  for (const char* variable : {"OMP_STACKSIZE", "GOMP_STACKSIZE"}) {
    const char* text = std::getenv(variable);
    if (text == nullptr) continue;
    if (const auto bytes = parse_size(text)) return {*bytes, fmt::format("{}={}", variable, text)};
  }
  std::size_t bytes = 0;
  pthread_attr_getstacksize(&attributes, &bytes);
  return {static_cast<double>(bytes), fmt::format("the limit on stacks ('ulimit -s') of {:.0f} KiB", bytes / 1024.0)};
}

void check_size(const StackSize& size) {
  if (size.bytes >= smallest_stack) return;
  throw Error(ExitCode::usage, fmt::format("{} leaves threads too little room: it must be {:.0f} KiB or more",
                                           size.source, smallest_stack / 1024.0));
}

void check_own_stack() {
  rlimit limit{};
  if (getrlimit(RLIMIT_STACK, &limit) != 0 || limit.rlim_cur == RLIM_INFINITY) return;
  const auto bytes = static_cast<double>(limit.rlim_cur);
  check_size({bytes, fmt::format("the limit on stacks ('ulimit -s') of {:.0f} KiB", bytes / 1024.0)});
}

void* wait_at(void* gate) {
  const std::lock_guard<std::mutex> passed(*static_cast<std::mutex*>(gate));
  return nullptr;
}

/// Starts so many threads that live at the same time, and ends them. @returns the error of the one that did not start
int try_threads(const int n_threads, const pthread_attr_t& attributes) {
  std::mutex gate;
  std::vector<pthread_t> threads;
  int error = 0;
  {
    const std::lock_guard<std::mutex> closed(gate);
    while (error == 0 && static_cast<int>(threads.size()) < n_threads) {
      pthread_t thread{};
      error = pthread_create(&thread, &attributes, wait_at, &gate);
      if (error == 0) threads.push_back(thread);
    }
  }
  for (const pthread_t thread : threads) pthread_join(thread, nullptr);
  return error;
}

}  // namespace

void check_thread_stacks(const int n_threads) {
  check_own_stack();
  pthread_attr_t attributes;
  pthread_attr_init(&attributes);
  const StackSize size = find_stack_size(attributes);
  check_size(size);
  // Sizes that do not fit are refused here or by the start of a thread.
  constexpr double most_bytes = 1e18;
  int error =
      size.bytes > most_bytes ? ENOMEM : pthread_attr_setstacksize(&attributes, static_cast<std::size_t>(size.bytes));
  if (error == 0) error = try_threads(n_threads - 1, attributes);
  pthread_attr_destroy(&attributes);
  if (error == 0) return;
  throw ResourceError(
      fmt::format("{} threads, each with a stack of {:.3g} MB, cannot be started: {}. Ask for fewer with --threads, "
                  "or look at 'ulimit -u', 'ulimit -v' and OMP_STACKSIZE.",
                  n_threads, 1e-6 * size.bytes, std::strerror(error)));
}

}  // namespace skein
