#pragma once

#include <skein/ranks/communicator.hpp>

#include <mpi.h>

#include <atomic>
#include <mutex>
#include <string>
#include <thread>

namespace skein {

/// Since any moment.
double monotonic_seconds();

class PulseBook;

/// What one rank knows of the others' being there and of its own work: a thread that sends and hears pulses and looks
/// at the clock, and ends this process where the run is lost.
class RankMonitor {
 public:
  ~RankMonitor() { stop(); }

  /// @param pulses  nobody else's  @param watches  false: no thread, as where MPI does not allow one
  void start(MPI_Comm pulses, int rank, int size, bool watches);
  void stop();
  bool watches() const { return watches_; }

  void begin_work(RankWork kind);
  void end_work();
  /// The work waits for others, and goes on.
  void pause_work();
  void go_on_with_work();
  double work_seconds() const { return work_seconds_; }

  /// @throws RankError where another rank is lost or has failed, which is known from then on to have been said
  void look() {
    if (has_problem_.load()) throw_problem();
  }
  std::string problem();

  /// Tells rank 0 why this rank cannot go on, and ends.
  [[noreturn]] void fail(int exit_code, const std::string& message);

 private:
  void watch();
  void send_pulse(int other);
  void hear(PulseBook& book);
  void note_problem(int exit_code, const std::string& text);
  [[noreturn]] void throw_problem();
  [[noreturn]] void give_up(const std::string& text);

  MPI_Comm pulses_ = MPI_COMM_NULL;
  int rank_ = 0, size_ = 1;
  bool watches_ = false, works_ = false;
  double work_seconds_ = 0.0;
  std::atomic<double> work_since_{-1.0}, problem_at_{0.0};
  std::atomic<double> longest_work_[n_kinds_of_rank_work] = {};  ///< of each kind
  std::atomic<std::size_t> kind_{0};
  std::atomic<bool> is_over_{false}, has_problem_{false}, is_said_{false};
  std::atomic<int> problem_code_{0};
  std::mutex mutex_;
  std::string problem_;
  std::thread thread_;
};

}  // namespace skein
