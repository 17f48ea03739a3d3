#include <skein/ranks/rank_error.hpp>

#include "mpi/launch.hpp"
#include "mpi/mpi_checks.hpp"
#include "mpi/point_to_point.hpp"
#include "mpi/rank_watch.hpp"

#include <fmt/format.h>
#include <mpi.h>
#include <unistd.h>

#include <atomic>
#include <chrono>
#include <climits>
#include <cstdio>
#include <ctime>
#include <memory>
#include <mutex>
#include <thread>
#include <utility>

// All collectives are non-blocking and polled, so that a rank that is lost is noticed while others wait for it; a
// thread of its own sends and hears pulses and looks at the clock.

namespace skein {
namespace {

constexpr std::size_t largest_piece = std::size_t{1} << 30;    // bytes of one broadcast: counts are ints
constexpr std::size_t least_scattered = std::size_t{1} << 16;  // bytes of a broadcast by which links are filled
constexpr int yield_after = 200, sleep_after = 20000;          // tests of a request
constexpr auto nap = std::chrono::microseconds(50);
constexpr auto tick = std::chrono::milliseconds(250);
constexpr double grace = 2.0;        // seconds that rank 0 has to say what is wrong before it is ended
constexpr double farewell = 3.0;     // and that all have to come to the end together
constexpr double forgetting = 0.98;  // of a long piece of work that has not come again, at each one since
constexpr int pulse_tag = 1, failure_tag = 2;

double read_clock(const clockid_t clock) {
  timespec time{};
  clock_gettime(clock, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}
double now() { return read_clock(CLOCK_MONOTONIC); }

std::vector<int> to_ints(const std::vector<std::size_t>& numbers) {
  std::vector<int> result;
  for (const std::size_t number : numbers) result.push_back(to_int(number));
  return result;
}

class MpiCommunicator final : public Communicator {
 public:
  MpiCommunicator() {
    int level = MPI_THREAD_SINGLE;
    if (MPI_Init_thread(nullptr, nullptr, MPI_THREAD_MULTIPLE, &level) != MPI_SUCCESS)
      throw Error(ExitCode::io_error, "MPI does not begin");
    check_mpi(MPI_Comm_dup(MPI_COMM_WORLD, &sums_), "MPI_Comm_dup");
    check_mpi(MPI_Comm_dup(MPI_COMM_WORLD, &pulses_), "MPI_Comm_dup");
    for (const MPI_Comm communicator : {sums_, pulses_}) MPI_Comm_set_errhandler(communicator, MPI_ERRORS_RETURN);
    MPI_Comm_rank(sums_, &rank_);
    MPI_Comm_size(sums_, &size_);
    // As rank 0 has it, or ranks would wait for what others do not send.
    int reaches = rank_ == 0 && skein::reaches_device_memory() ? 1 : 0;
    check_mpi(MPI_Bcast(&reaches, 1, MPI_INT, 0, sums_), "MPI_Bcast");
    reaches_device_memory_ = reaches != 0;
    is_watched_ = level == MPI_THREAD_MULTIPLE && size_ > 1;
    if (is_watched_) watch_ = std::thread([this] { watch(); });
  }

  ~MpiCommunicator() override { stop_watch(); }

  int rank() const override { return rank_; }
  int size() const override { return size_; }
  std::string describe() const override {
    return fmt::format("{}{}{}", describe_mpi(),
                       reaches_device_memory_ ? ", which takes what is in the memory of devices" : "",
                       is_watched_ || size_ == 1 ? "" : ", which notices no rank that hangs (no MPI_THREAD_MULTIPLE)");
  }

  bool reaches_device_memory() const override { return reaches_device_memory_; }

  void broadcast(void* data, std::size_t bytes) override {
    traffic_.broadcast_bytes += static_cast<double>(bytes);
    for (auto* at = static_cast<char*>(data); bytes > 0;) {
      const std::size_t piece = std::min(bytes, largest_piece);
      if (size_ > 2 && piece >= least_scattered) {
        scatter_to_all(at, piece);
      } else {
        MPI_Request request;
        check_mpi(MPI_Ibcast(at, static_cast<int>(piece), MPI_BYTE, 0, sums_, &request), "MPI_Ibcast");
        wait(request);
      }
      at += piece;
      bytes -= piece;
    }
  }

  void gather(const double* own, const RankParts& parts, double* all) override {
    const std::vector<int> count = to_ints(parts.count), first = to_ints(parts.first);
    traffic_.gathered_bytes +=
        sizeof(double) * static_cast<double>(rank_ == 0 ? parts.total() : parts.count[own_rank()]);
    if (reaches_device_memory_) return wait_for(by_messages().gather(own, parts, all));
    MPI_Request request;
    check_mpi(MPI_Igatherv(own, count[own_rank()], MPI_DOUBLE, all, count.data(), first.data(), MPI_DOUBLE, 0, sums_,
                           &request),
              "MPI_Igatherv");
    wait(request);
  }

  void gather_to_all(const std::vector<double*>& columns, const RankParts& parts) override {
    const std::vector<int> count = to_ints(parts.count), first = to_ints(parts.first);
    traffic_.shared_bytes += sizeof(double) * static_cast<double>(columns.size() * parts.total());
    if (reaches_device_memory_) return wait_for(by_messages().gather_to_all(columns, parts));
    std::vector<MPI_Request> requests(columns.size());  // all of them on their way together
    for (std::size_t c = 0; c < columns.size(); ++c)
      check_mpi(MPI_Iallgatherv(MPI_IN_PLACE, 0, MPI_DOUBLE, columns[c], count.data(), first.data(), MPI_DOUBLE, sums_,
                                &requests[c]),
                "MPI_Iallgatherv");
    wait_for(std::move(requests));
  }

  void exchange(const double* send, const RankParts& sent, double* receive, const RankParts& received) override {
    const std::vector<int> n_sent = to_ints(sent.count), first_sent = to_ints(sent.first);
    const std::vector<int> n_received = to_ints(received.count), first_received = to_ints(received.first);
    for (int other = 0; other < size_; ++other)
      if (other != rank_)
        traffic_.exchanged_bytes += static_cast<double>(sizeof(double) * sent.count[static_cast<std::size_t>(other)]);
    if (reaches_device_memory_) return wait_for(by_messages().exchange(send, sent, receive, received));
    MPI_Request request;
    check_mpi(MPI_Ialltoallv(send, n_sent.data(), first_sent.data(), MPI_DOUBLE, receive, n_received.data(),
                             first_received.data(), MPI_DOUBLE, sums_, &request),
              "MPI_Ialltoallv");
    wait(request);
  }

  void begin_work(const RankWork kind) override {
    kind_ = static_cast<std::size_t>(kind);
    works_ = true;
    work_since_ = now();
  }
  void end_work() override {
    note_work();
    works_ = false;
  }

  double work_seconds() const override { return work_seconds_; }
  RankTraffic traffic() const override { return traffic_; }

  [[noreturn]] void fail(const int exit_code, const std::string& message) override {
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

  /// At the end of the program.
  int leave(const int exit_code) {
    const double start = now();
    bool are_together = false;
    MPI_Request request;
    if (problem().empty() && MPI_Ibarrier(sums_, &request) == MPI_SUCCESS)
      for (int done = 0; !are_together && problem().empty() && now() - start < farewell; are_together = done != 0) {
        if (MPI_Test(&request, &done, MPI_STATUS_IGNORE) != MPI_SUCCESS) break;
        std::this_thread::sleep_for(nap);
      }
    stop_watch();
    std::fflush(nullptr);
    if (!are_together) _exit(exit_code != 0 ? exit_code : static_cast<int>(ExitCode::io_error));
    MPI_Finalize();
    return exit_code;
  }

 private:
  /// A part to each rank, which gives it to all others: rank 0's link carries no more than twice the bytes, whatever
  /// the number of ranks.
  void scatter_to_all(char* const data, const std::size_t bytes) {
    std::vector<int> first, count;
    for (int rank = 0; rank < size_; ++rank) {
      first.push_back(static_cast<int>(bytes * static_cast<std::size_t>(rank) / static_cast<std::size_t>(size_)));
      if (rank > 0) count.push_back(first.back() - first[static_cast<std::size_t>(rank) - 1]);
    }
    count.push_back(static_cast<int>(bytes) - first.back());
    MPI_Request request;
    if (rank_ == 0)
      check_mpi(
          MPI_Iscatterv(data, count.data(), first.data(), MPI_BYTE, MPI_IN_PLACE, 0, MPI_BYTE, 0, sums_, &request),
          "MPI_Iscatterv");
    else
      check_mpi(MPI_Iscatterv(nullptr, nullptr, nullptr, MPI_BYTE, data + first[own_rank()], count[own_rank()],
                              MPI_BYTE, 0, sums_, &request),
                "MPI_Iscatterv");
    wait(request);
    check_mpi(MPI_Iallgatherv(MPI_IN_PLACE, 0, MPI_BYTE, data, count.data(), first.data(), MPI_BYTE, sums_, &request),
              "MPI_Iallgatherv");
    wait(request);
  }

  PointToPoint by_messages() const { return {sums_, rank_, size_}; }
  void wait_for(std::vector<MPI_Request> requests) {
    for (MPI_Request& request : requests) wait(request);
  }

  std::size_t own_rank() const { return static_cast<std::size_t>(rank_); }

  void wait(MPI_Request& request) {
    note_work();
    const double start = now();
    int done = 0;
    for (int n_tests = 0; done == 0; ++n_tests) {
      check_mpi(MPI_Test(&request, &done, MPI_STATUS_IGNORE), "MPI_Test");
      if (has_problem_.load()) throw_problem();
      if (n_tests > sleep_after)
        std::this_thread::sleep_for(nap);
      else if (n_tests > yield_after)
        std::this_thread::yield();
    }
    traffic_.messages += 1.0;
    traffic_.wait_seconds += now() - start;
    if (works_) work_since_ = now();
  }

  /// A piece of work is over, or waits for others.
  void note_work() {
    const double since = work_since_.exchange(-1.0);
    if (since < 0.0) return;
    const double seconds = now() - since;
    work_seconds_ += seconds;
    std::atomic<double>& longest = longest_work_[kind_];
    longest = std::max(forgetting * longest, seconds);
  }

  std::string problem() {
    const std::lock_guard lock(mutex_);
    return problem_;
  }
  [[noreturn]] void throw_problem() {
    is_said_ = true;
    throw RankError(static_cast<ExitCode>(problem_code_.load()), problem());
  }
  void note_problem(const int exit_code, const std::string& text) {
    {
      const std::lock_guard lock(mutex_);
      if (!problem_.empty()) return;
      problem_ = text;
    }
    problem_code_ = exit_code;
    problem_at_ = now();
    has_problem_ = true;
  }

  void watch() {
    std::vector<int> watched;
    for (int other = rank_ == 0 ? 1 : 0; other < (rank_ == 0 ? size_ : 1); ++other) watched.push_back(other);
    PulseBook book(watched, now());
    WorkWatch work;
    while (!is_over_) {
      hear(book);
      for (const int other : watched) send_pulse(other);
      if (const int silent = book.look(now()); silent >= 0)
        note_problem(
            static_cast<int>(ExitCode::io_error),
            fmt::format("rank {} has not been heard of for {:g} s: its process is stopped, or its machine is not "
                        "to be reached",
                        silent, PulseBook::longest_silence));
      if (const std::string fault =
              work.look(now(), work_since_, longest_work_[kind_], read_clock(CLOCK_PROCESS_CPUTIME_ID));
          !fault.empty())
        give_up(fmt::format("rank {} {}", rank_, fault));
      if (has_problem_ && !is_said_ && now() - problem_at_ > grace) give_up(problem());
      std::this_thread::sleep_for(tick);
    }
  }

  void send_pulse(const int other) {
    MPI_Request request;
    if (MPI_Isend(nullptr, 0, MPI_CHAR, other, pulse_tag, pulses_, &request) == MPI_SUCCESS) MPI_Request_free(&request);
  }

  void hear(PulseBook& book) {
    int there = 0;
    MPI_Status status;
    while (MPI_Iprobe(MPI_ANY_SOURCE, MPI_ANY_TAG, pulses_, &there, &status) == MPI_SUCCESS && there != 0) {
      int length = 0;
      MPI_Get_count(&status, MPI_CHAR, &length);
      std::string text(static_cast<std::size_t>(length), ' ');
      MPI_Recv(text.data(), length, MPI_CHAR, status.MPI_SOURCE, status.MPI_TAG, pulses_, MPI_STATUS_IGNORE);
      book.hear(status.MPI_SOURCE, now());
      if (status.MPI_TAG != failure_tag) continue;
      const auto colon = text.find(':');
      note_problem(std::stoi(text.substr(0, colon)), text.substr(colon + 1));
    }
  }

  /// From the thread that watches: this process cannot say it by itself. Where rank 0 lives it is the one to speak.
  [[noreturn]] void give_up(const std::string& text) {
    const int code = has_problem_ ? problem_code_.load() : static_cast<int>(ExitCode::io_error);
    if (rank_ > 0 && !has_problem_) {
      is_over_ = true;
      fail(code, text.substr(text.find(' ', text.find(' ') + 1) + 1));
    }
    if (rank_ > 1) std::this_thread::sleep_for(std::chrono::duration<double>(2.0 * grace));
    std::fputs(fmt::format("skein: {}\n", text).c_str(), stderr);
    _exit(code);
  }

  void stop_watch() {
    is_over_ = true;
    if (watch_.joinable()) watch_.join();
  }

  MPI_Comm sums_ = MPI_COMM_NULL, pulses_ = MPI_COMM_NULL;
  int rank_ = 0, size_ = 1;
  bool reaches_device_memory_ = false, is_watched_ = false, works_ = false;
  double work_seconds_ = 0.0;
  RankTraffic traffic_;
  std::atomic<double> work_since_{-1.0}, problem_at_{0.0};
  std::atomic<double> longest_work_[n_kinds_of_rank_work] = {};  ///< of each kind
  std::atomic<std::size_t> kind_{0};
  std::atomic<bool> is_over_{false}, has_problem_{false}, is_said_{false};
  std::atomic<int> problem_code_{0};
  std::mutex mutex_;
  std::string problem_;
  std::thread watch_;
};

std::unique_ptr<MpiCommunicator> joined;

}  // namespace

Communicator* join_ranks() {
  if (find_launch().size == 0) return nullptr;
  if (joined == nullptr) joined = std::make_unique<MpiCommunicator>();
  return joined.get();
}

int leave_ranks(const int exit_code) {
  if (joined == nullptr) return exit_code;
  const int code = joined->leave(exit_code);
  joined.reset();
  return code;
}

std::string describe_mpi() {
  char text[MPI_MAX_LIBRARY_VERSION_STRING] = "";
  int length = 0;
  MPI_Get_library_version(text, &length);
  const std::string version(text, static_cast<std::size_t>(length));
  return version.substr(0, version.find_first_of(",\n"));
}

}  // namespace skein
