#pragma once

#include <sys/types.h>

#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace skein {

/// How a piece of work ended.
struct WorkEnd {
  std::size_t item;
  int exit_code;        ///< 0 where a signal ended it
  int signal;           ///< that ended the process; 0 if it ended by itself
  std::string message;  ///< that the work left
  double seconds;       ///< of wall time
};

/// Pieces of work in processes of their own: copies of this one, which hand over what they are to do in memory and
/// cannot harm each other. They are asked to stop (SIGTERM) when this process ends, however it does.
class ProcessPool {
 public:
  /// Is given a Kokkos of its own. What it throws becomes exit code and message.
  /// @returns the exit code
  using Work = std::function<int()>;

  ProcessPool() = default;
  ~ProcessPool();  ///< kills what still runs
  ProcessPool(const ProcessPool&) = delete;
  ProcessPool& operator=(const ProcessPool&) = delete;

  /// This process must have no other thread, and no Kokkos. @throws ResourceError if the system starts no process
  void start(std::size_t item, int n_threads, const Work& work);

  /// Waits until a piece of work ends, for so long at most; signals cut it short.
  std::optional<WorkEnd> wait(double seconds);

  void signal_all(int signal) const;
  std::size_t n_running() const { return running_.size(); }

  /// Threads of those that run.
  int n_threads() const;

 private:
  struct Process {
    std::size_t item;
    pid_t id;
    int pipe;  ///< closed at the other end when the process ends; its message comes through it
    int n_threads;
    std::string message;
    double began;
  };

  WorkEnd take(std::size_t index);

  std::vector<Process> running_;
};

/// "SIGKILL", or its number for an unusual one.
std::string name_of_signal(int signal);

}  // namespace skein
