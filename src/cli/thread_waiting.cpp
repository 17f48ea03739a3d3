#include "cli/thread_waiting.hpp"

#include <cstdlib>

#if defined(__linux__) && defined(__GNUC__) && !defined(__clang__) && defined(SKEIN_HAS_OPENMP)
#define SKEIN_RESTARTS_FOR_OPENMP
#include <omp.h>
#include <sched.h>
#include <unistd.h>

#include <fstream>
#include <string>
#include <vector>
#endif

namespace skein {
namespace {

#ifdef SKEIN_RESTARTS_FOR_OPENMP
/// With OMP_PROC_BIND the library has bound this thread to its own processor already, and all threads of the program
/// started anew would have to share that one: back to the processors of all places.
void leave_own_place() {
  cpu_set_t processors;
  CPU_ZERO(&processors);
  for (int place = 0; place < omp_get_num_places(); ++place) {
    std::vector<int> ids(static_cast<std::size_t>(omp_get_place_num_procs(place)));
    omp_get_place_proc_ids(place, ids.data());
    for (const int id : ids)
      if (id < CPU_SETSIZE) CPU_SET(static_cast<std::size_t>(id), &processors);
  }
  if (CPU_COUNT(&processors) > 0) sched_setaffinity(0, sizeof processors, &processors);
}

/// The words that this program was called with.
std::vector<std::string> read_own_words() {
  std::ifstream file("/proc/self/cmdline", std::ios::binary);
  std::vector<std::string> words;
  for (std::string word; std::getline(file, word, '\0');) words.push_back(word);
  return words;
}
#endif

}  // namespace

void limit_thread_spinning([[maybe_unused]] char** argv) {
#ifdef SKEIN_RESTARTS_FOR_OPENMP
  if (std::getenv("GOMP_SPINCOUNT") != nullptr || std::getenv("OMP_WAIT_POLICY") != nullptr) return;
  if (setenv("GOMP_SPINCOUNT", "10000", 0) != 0) return;
  leave_own_place();
  execv("/proc/self/exe", argv);  // returns only where it is not possible; then the run is merely slower
#endif
}

void leave_threads_unbound() {
#ifdef SKEIN_RESTARTS_FOR_OPENMP
  if (omp_get_proc_bind() == omp_proc_bind_false) return;
  leave_own_place();
  if (setenv("OMP_PROC_BIND", "false", 1) != 0 || unsetenv("OMP_PLACES") != 0 || unsetenv("GOMP_CPU_AFFINITY") != 0)
    return;
  std::vector<std::string> words = read_own_words();
  std::vector<char*> pointers;
  for (std::string& word : words) pointers.push_back(word.data());
  pointers.push_back(nullptr);
  execv("/proc/self/exe", pointers.data());
#endif
}

}  // namespace skein
