#include <skein/core/error.hpp>

#include "mpi/launch.hpp"
#include "mpi/mpi_checks.hpp"
#include "mpi/point_to_point.hpp"
#include "mpi/rank_monitor.hpp"

#include <fmt/format.h>
#include <mpi.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <memory>
#include <thread>
#include <utility>

// All moves are non-blocking and polled, so that a rank that is lost is noticed while others wait for it.

namespace skein {
namespace {

constexpr std::size_t largest_piece = std::size_t{1} << 30;    // bytes of one broadcast: counts are ints
constexpr std::size_t least_scattered = std::size_t{1} << 16;  // bytes of a broadcast by which links are filled
constexpr int yield_after = 200, sleep_after = 20000;          // tests of a request
constexpr auto nap = std::chrono::microseconds(50);
constexpr double farewell = 3.0;  // seconds that all have to come to the end together

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
    MPI_Comm pulses;
    check_mpi(MPI_Comm_dup(MPI_COMM_WORLD, &pulses), "MPI_Comm_dup");
    for (const MPI_Comm communicator : {sums_, pulses}) MPI_Comm_set_errhandler(communicator, MPI_ERRORS_RETURN);
    MPI_Comm_rank(sums_, &rank_);
    MPI_Comm_size(sums_, &size_);
    // As rank 0 has it, or ranks would wait for what others do not send.
    int reaches = rank_ == 0 && skein::reaches_device_memory() ? 1 : 0;
    check_mpi(MPI_Bcast(&reaches, 1, MPI_INT, 0, sums_), "MPI_Bcast");
    reaches_device_memory_ = reaches != 0;
    monitor_.start(pulses, rank_, size_, level == MPI_THREAD_MULTIPLE && size_ > 1);
  }

  int rank() const override { return rank_; }
  int size() const override { return size_; }
  std::string describe() const override {
    return fmt::format(
        "{}{}{}", describe_mpi(), reaches_device_memory_ ? ", which takes what is in the memory of devices" : "",
        monitor_.watches() || size_ == 1 ? "" : ", which notices no rank that hangs (no MPI_THREAD_MULTIPLE)");
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

  void begin_work(const RankWork kind) override { monitor_.begin_work(kind); }
  void end_work() override { monitor_.end_work(); }
  double work_seconds() const override { return monitor_.work_seconds(); }
  RankTraffic traffic() const override { return traffic_; }
  [[noreturn]] void fail(const int exit_code, const std::string& message) override {
    monitor_.fail(exit_code, message);
  }

  /// At the end of the program.
  int leave(const int exit_code) {
    const double start = monotonic_seconds();
    bool are_together = false;
    MPI_Request request;
    if (monitor_.problem().empty() && MPI_Ibarrier(sums_, &request) == MPI_SUCCESS)
      for (int done = 0; !are_together && monitor_.problem().empty() && monotonic_seconds() - start < farewell;
           are_together = done != 0) {
        if (MPI_Test(&request, &done, MPI_STATUS_IGNORE) != MPI_SUCCESS) break;
        std::this_thread::sleep_for(nap);
      }
    monitor_.stop();
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
    monitor_.pause_work();
    const double start = monotonic_seconds();
    int done = 0;
    for (int n_tests = 0; done == 0; ++n_tests) {
      check_mpi(MPI_Test(&request, &done, MPI_STATUS_IGNORE), "MPI_Test");
      monitor_.look();
      if (n_tests > sleep_after)
        std::this_thread::sleep_for(nap);
      else if (n_tests > yield_after)
        std::this_thread::yield();
    }
    traffic_.messages += 1.0;
    traffic_.wait_seconds += monotonic_seconds() - start;
    monitor_.go_on_with_work();
  }

  MPI_Comm sums_ = MPI_COMM_NULL;
  int rank_ = 0, size_ = 1;
  bool reaches_device_memory_ = false;
  RankTraffic traffic_;
  RankMonitor monitor_;
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
