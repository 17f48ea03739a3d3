#include "mpi/point_to_point.hpp"

#include <skein/core/error.hpp>

#include "mpi/mpi_checks.hpp"

#include <cstdlib>
#include <string>

#ifdef OPEN_MPI
#include <mpi-ext.h>
#endif

namespace skein {
namespace {

constexpr int move_tag = 3;

bool library_reaches_device_memory() {
#ifdef MPIX_CUDA_AWARE_SUPPORT
  if (MPIX_Query_cuda_support() != 0) return true;
#endif
#ifdef OMPI_HAVE_MPI_EXT_ROCM
  if (MPIX_Query_rocm_support() != 0) return true;
#endif
#ifdef MPIX_GPU_SUPPORT_CUDA
  for (const int kind : {MPIX_GPU_SUPPORT_CUDA, MPIX_GPU_SUPPORT_HIP}) {
    int is_supported = 0;
    if (MPIX_GPU_query_support(kind, &is_supported) == MPI_SUCCESS && is_supported != 0) return true;
  }
#endif
  return false;
}

}  // namespace

bool reaches_device_memory() {
  const char* const said = std::getenv("SKEIN_GPU_AWARE_MPI");
  const std::string word = said == nullptr ? "" : said;
  if (word.empty()) return library_reaches_device_memory();
  if (word != "on" && word != "off")
    throw Error(ExitCode::usage,
                "SKEIN_GPU_AWARE_MPI is neither on nor off: whether MPI takes what is in the memory of devices");
  return word == "on";
}

void PointToPoint::send(const double* const from, const std::size_t n, const int to,
                        std::vector<MPI_Request>& requests) const {
  if (n == 0) return;
  requests.emplace_back();
  check_mpi(MPI_Isend(from, to_int(n), MPI_DOUBLE, to, move_tag, communicator_, &requests.back()), "MPI_Isend");
}

void PointToPoint::receive(double* const to, const std::size_t n, const int from,
                           std::vector<MPI_Request>& requests) const {
  if (n == 0) return;
  requests.emplace_back();
  check_mpi(MPI_Irecv(to, to_int(n), MPI_DOUBLE, from, move_tag, communicator_, &requests.back()), "MPI_Irecv");
}

std::vector<MPI_Request> PointToPoint::gather(const double* const own, const RankParts& parts,
                                              double* const all) const {
  RankParts none;
  none.first = none.count = std::vector<std::size_t>(static_cast<std::size_t>(size_));
  RankParts to_first = none;
  to_first.count[0] = parts.count[static_cast<std::size_t>(rank_)];
  return exchange(own, to_first, all, rank_ == 0 ? parts : none);
}

std::vector<MPI_Request> PointToPoint::gather_to_all(const std::vector<double*>& columns,
                                                     const RankParts& parts) const {
  std::vector<MPI_Request> requests;
  const auto own = static_cast<std::size_t>(rank_);
  for (double* const column : columns)
    for (int other = 0; other < size_; ++other) {
      const auto r = static_cast<std::size_t>(other);
      if (other != rank_) receive(column + parts.first[r], parts.count[r], other, requests);
    }
  for (const double* const column : columns)
    for (int other = 0; other < size_; ++other)
      if (other != rank_) send(column + parts.first[own], parts.count[own], other, requests);
  return requests;
}

// What a rank sends to itself, too, so that nobody else has to copy in the memory of a device.
std::vector<MPI_Request> PointToPoint::exchange(const double* const send_from, const RankParts& sent,
                                                double* const receive_to, const RankParts& received) const {
  std::vector<MPI_Request> requests;
  for (int other = 0; other < size_; ++other) {
    const auto r = static_cast<std::size_t>(other);
    receive(receive_to + received.first[r], received.count[r], other, requests);
  }
  for (int other = 0; other < size_; ++other) {
    const auto r = static_cast<std::size_t>(other);
    send(send_from + sent.first[r], sent.count[r], other, requests);
  }
  return requests;
}

}  // namespace skein
