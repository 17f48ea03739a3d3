#pragma once

#include "runs/child_run.hpp"
#include "studies/run_results.hpp"

#include <filesystem>
#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <vector>

namespace skein {

/// Runs that have nothing to do with each other.
struct RunList {
  std::filesystem::path runs;               ///< folder of their folders
  std::filesystem::path results;            ///< folder of what was measured in them
  std::vector<std::string> names;           ///< of their folders
  std::vector<double> costs;                ///< of each, against the others: the dearest begin first
  std::vector<int> useful_threads;          ///< of each: more would not make it faster
  std::size_t largest_memory = 0;           ///< bytes of the largest
  std::function<NewRun(std::size_t)> make;  ///< called in the process of that run

  std::filesystem::path run(const std::size_t i) const { return runs / names[i]; }
  std::filesystem::path result(const std::size_t i) const { return results / (names[i] + ".h5"); }
};

/// Adds what a run of this scene costs against the others, its threads and its memory.
void add_estimates(RunList& list, const SceneConfig& scene);

/// How they share the machine.
struct SideBySide {
  int n_jobs = 0;     ///< processes at a time; 0: as many as have the most runs per hour
  int n_threads = 0;  ///< host threads of all of them; 0: as of one run
  double max_walltime = std::numeric_limits<double>::infinity();  ///< seconds since the program began
  std::filesystem::path stop_file;                                ///< ends them like a signal where it appears
};

/// Who is told how they go.
class SideBySideListener {
 public:
  virtual ~SideBySideListener() = default;
  virtual void begin(std::size_t /*n_open*/, int /*n_jobs*/, int /*n_threads*/) {}
  /// A run is done, has failed, or was asked to stop.
  virtual void end_of_run(std::size_t /*run*/, const RunResult& /*result*/, double /*seconds*/) {}
  /// Now and then. @param n_running  processes
  virtual void look(std::size_t /*n_running*/) {}
};

/// Brings runs to their ends in processes of their own, so many at a time, and measures each. A run that is there goes
/// on; one whose process is killed is tried again. This process must have no Kokkos and one thread.
/// @param open  which of the list
/// @returns of each open run how it came out; nothing for one that was stopped or not begun
/// @throws Error(io_error) if the disk is full or fails: so it would for the rest. Error(usage) if the environment
/// allows
///         no run.
std::vector<std::optional<RunResult>> run_side_by_side(const RunList& list, const std::vector<std::size_t>& open,
                                                       const SideBySide& how, SideBySideListener& listener);

}  // namespace skein
