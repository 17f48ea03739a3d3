#pragma once

#include <skein/ranks/communicator.hpp>

#include <mpi.h>

#include <vector>

namespace skein {

/// Whether this MPI takes pointers into a device's memory: what SKEIN_GPU_AWARE_MPI says in the environment, on or off,
/// else what the library says of itself. @throws Error(usage) where the variable says anything else
bool reaches_device_memory();

/// The moves of a communicator by messages between two ranks each. Libraries that take pointers into a device's memory
/// take them in messages, and in collectives that block; not in those that a lost rank leaves to be given up, which do
/// not block (Open MPI 4.1, FAQ "Running CUDA-aware Open MPI"). To be called by all ranks, in the same order.
class PointToPoint {
 public:
  PointToPoint(MPI_Comm communicator, int rank, int size) : communicator_(communicator), rank_(rank), size_(size) {}

  /// As those of Communicator. @returns what is on its way then
  std::vector<MPI_Request> gather(const double* own, const RankParts& parts, double* all) const;
  std::vector<MPI_Request> gather_to_all(const std::vector<double*>& columns, const RankParts& parts) const;
  std::vector<MPI_Request> exchange(const double* send, const RankParts& sent, double* receive,
                                    const RankParts& received) const;

 private:
  void send(const double* from, std::size_t n, int to, std::vector<MPI_Request>& requests) const;
  void receive(double* to, std::size_t n, int from, std::vector<MPI_Request>& requests) const;

  MPI_Comm communicator_;
  int rank_, size_;
};

}  // namespace skein
