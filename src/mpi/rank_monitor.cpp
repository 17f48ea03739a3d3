#include "mpi/rank_monitor.hpp"

#include <skein/ranks/rank_error.hpp>

#include "mpi/rank_watch.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <ctime>
#include <vector>

namespace skein {
namespace {

constexpr auto tick = std::chrono::milliseconds(250);
constexpr double grace = 2.0;        // seconds that rank 0 has to say what is wrong before it is ended
constexpr double forgetting = 0.98;  // of a long piece of work that has not come again, at each one since
constexpr int pulse_tag = 1, failure_tag = 2;

double read_clock(const clockid_t clock) {
  timespec time{};
  clock_gettime(clock, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

}  // namespace

double monotonic_seconds() { return read_clock(CLOCK_MONOTONIC); }

void RankMonitor::start(MPI_Comm pulses, const int rank, const int size, const bool watches) {
  pulses_ = pulses;
  rank_ = rank;
  size_ = size;
  watches_ = watches;
  if (watches_) thread_ = std::thread([this] { watch(); });
}

void RankMonitor::go_on_with_work() {
  if (works_) work_since_ = monotonic_seconds();
}

void RankMonitor::begin_work(const RankWork kind) {
  kind_ = static_cast<std::size_t>(kind);
  works_ = true;
  work_since_ = monotonic_seconds();
}

void RankMonitor::end_work() {
  pause_work();
  works_ = false;
}

void RankMonitor::fail(const int exit_code, const std::string& message) {
  end_work();
  // A process that leaves without finishing MPI ends all others: rank 0 has time to say why, and to save what there
  // is.
  const std::string report = fmt::format("{}:rank {}: {}", exit_code, rank_, message);
  MPI_Request request;
  if (rank_ > 0 && MPI_Isend(report.data(), static_cast<int>(report.size()), MPI_CHAR, 0, failure_tag, pulses_,
                             &request) == MPI_SUCCESS)
    std::this_thread::sleep_for(std::chrono::duration<double>(2.0 * grace));
  _exit(exit_code);
}

/// A piece of work is over, or waits for others.
void RankMonitor::pause_work() {
  const double since = work_since_.exchange(-1.0);
  if (since < 0.0) return;
  const double seconds = monotonic_seconds() - since;
  work_seconds_ += seconds;
  std::atomic<double>& longest = longest_work_[kind_];
  longest = std::max(forgetting * longest, seconds);
}

std::string RankMonitor::problem() {
  const std::lock_guard lock(mutex_);
  return problem_;
}

void RankMonitor::throw_problem() {
  is_said_ = true;
  throw RankError(static_cast<ExitCode>(problem_code_.load()), problem());
}

void RankMonitor::note_problem(const int exit_code, const std::string& text) {
  {
    const std::lock_guard lock(mutex_);
    if (!problem_.empty()) return;
    problem_ = text;
  }
  problem_code_ = exit_code;
  problem_at_ = monotonic_seconds();
  has_problem_ = true;
}

void RankMonitor::watch() {
  std::vector<int> watched;
  for (int other = rank_ == 0 ? 1 : 0; other < (rank_ == 0 ? size_ : 1); ++other) watched.push_back(other);
  PulseBook book(watched, monotonic_seconds());
  WorkWatch work;
  while (!is_over_) {
    hear(book);
    for (const int other : watched) send_pulse(other);
    if (const int silent = book.look(monotonic_seconds()); silent >= 0)
      note_problem(
          static_cast<int>(ExitCode::io_error),
          fmt::format("rank {} has not been heard of for {:g} s: its process is stopped, or its machine is not "
                      "to be reached",
                      silent, PulseBook::longest_silence));
    if (const std::string fault =
            work.look(monotonic_seconds(), work_since_, longest_work_[kind_], read_clock(CLOCK_PROCESS_CPUTIME_ID));
        !fault.empty())
      give_up(fmt::format("rank {} {}", rank_, fault));
    if (has_problem_ && !is_said_ && monotonic_seconds() - problem_at_ > grace) give_up(problem());
    std::this_thread::sleep_for(tick);
  }
}

void RankMonitor::send_pulse(const int other) {
  MPI_Request request;
  if (MPI_Isend(nullptr, 0, MPI_CHAR, other, pulse_tag, pulses_, &request) == MPI_SUCCESS) MPI_Request_free(&request);
}

void RankMonitor::hear(PulseBook& book) {
  int there = 0;
  MPI_Status status;
  while (MPI_Iprobe(MPI_ANY_SOURCE, MPI_ANY_TAG, pulses_, &there, &status) == MPI_SUCCESS && there != 0) {
    int length = 0;
    MPI_Get_count(&status, MPI_CHAR, &length);
    std::string text(static_cast<std::size_t>(length), ' ');
    MPI_Recv(text.data(), length, MPI_CHAR, status.MPI_SOURCE, status.MPI_TAG, pulses_, MPI_STATUS_IGNORE);
    book.hear(status.MPI_SOURCE, monotonic_seconds());
    if (status.MPI_TAG != failure_tag) continue;
    const auto colon = text.find(':');
    note_problem(std::stoi(text.substr(0, colon)), text.substr(colon + 1));
  }
}

/// From the thread that watches: this process cannot say it by itself. Where rank 0 lives it is the one to speak.
void RankMonitor::give_up(const std::string& text) {
  const int code = has_problem_ ? problem_code_.load() : static_cast<int>(ExitCode::io_error);
  if (rank_ > 0 && !has_problem_) {
    is_over_ = true;
    fail(code, text.substr(text.find(' ', text.find(' ') + 1) + 1));
  }
  if (rank_ > 1) std::this_thread::sleep_for(std::chrono::duration<double>(2.0 * grace));
  std::fputs(fmt::format("skein: {}\n", text).c_str(), stderr);
  _exit(code);
}

void RankMonitor::stop() {
  is_over_ = true;
  if (thread_.joinable()) thread_.join();
}

}  // namespace skein
