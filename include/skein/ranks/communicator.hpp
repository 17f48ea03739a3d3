#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace skein {

/// Where the numbers for each rank lie in one array, or those that came from it: `count[r]` doubles from `first[r]` on.
struct RankParts {
  std::vector<std::size_t> first, count;  ///< [size()]

  /// One behind the other.
  static RankParts behind_each_other(std::vector<std::size_t> count);
  /// As many for each rank, one more or less.
  static RankParts evenly(std::size_t n, int n_ranks);
  std::size_t total() const { return count.empty() ? 0 : first.back() + count.back(); }
};

/// What a process has sent and received since it began, and how long it has waited for it.
struct RankTraffic {
  double broadcast_bytes = 0.0, gathered_bytes = 0.0, exchanged_bytes = 0.0;
  double shared_bytes = 0.0;  ///< by gather_to_all: all of the arrays
  double messages = 0.0;      ///< calls that move something, of any kind
  double wait_seconds = 0.0;  ///< for others to come and for bytes to move
};

/// What a rank works on. How long it may take is judged by what took long before of the same kind.
enum class RankWork { forces, taking_nodes, direct_sum, fmm_sum };
inline constexpr std::size_t n_kinds_of_rank_work = 4;

/// Processes that compute one run together: rank 0 leads, the others do what it asks for. Arrays are in the host's
/// memory, where nothing else is said. Every function that sends is called by all ranks, in the same order.
///
/// @throws Error(io_error) from each of them where the ranks cannot reach each other; on rank 0 also what another rank
/// has reported by fail(), with its exit code.
class Communicator {
 public:
  virtual ~Communicator() = default;

  virtual int rank() const = 0;
  virtual int size() const = 0;
  /// One line: the library, its version, and how ranks that are lost are noticed.
  virtual std::string describe() const = 0;

  /// Whether arrays may be in a device's memory, too, but for those of `broadcast`.
  virtual bool reaches_device_memory() const { return false; }

  /// From rank 0 to all.
  virtual void broadcast(void* data, std::size_t bytes) = 0;

  /// What all ranks have, on rank 0. @param parts  of `all`, known to every rank; rank r sends count[r] doubles
  virtual void gather(const double* own, const RankParts& parts, double* all) = 0;

  /// What each rank has of some arrays, on all ranks. @param columns  [parts.total()] each, with this rank's part
  virtual void gather_to_all(const std::vector<double*>& columns, const RankParts& parts) = 0;

  /// From each rank to each. @param sent, received  count of what a rank sends equals that of what the other receives
  virtual void exchange(const double* send, const RankParts& sent, double* receive, const RankParts& received) = 0;

  /// A part of a sum begins and ends: in between this process computes, and if it does not although it should, the run
  /// is ended.
  virtual void begin_work(RankWork /*kind*/) {}
  virtual void end_work() {}
  /// Wall time that this process has worked since it began, seconds: without what it waited for others.
  virtual double work_seconds() const { return 0.0; }
  virtual RankTraffic traffic() const { return {}; }

  /// Tells rank 0 why this rank cannot go on, and waits to be ended.
  [[noreturn]] virtual void fail(int exit_code, const std::string& message) = 0;
};

/// To be called by all ranks: each number becomes the sum over ranks, added up in their order.
void add_up_to_all(Communicator& ranks, std::vector<double>& numbers);

/// To be called by all ranks, with as many numbers each: those of rank 0, then those of rank 1, and so on.
std::vector<double> list_from_all(Communicator& ranks, const std::vector<double>& own);

/// A process by itself: what is sent to rank 0, or by it, is there already.
class LoneProcess final : public Communicator {
 public:
  int rank() const override { return 0; }
  int size() const override { return 1; }
  std::string describe() const override { return "one process"; }
  void broadcast(void*, std::size_t) override {}
  void gather(const double* own, const RankParts& parts, double* all) override;
  void gather_to_all(const std::vector<double*>&, const RankParts&) override {}
  void exchange(const double* send, const RankParts& sent, double* receive, const RankParts& received) override;
  [[noreturn]] void fail(int exit_code, const std::string& message) override;
};

}  // namespace skein
