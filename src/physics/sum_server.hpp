#pragma once

#include <skein/fmm/fmm_sum.hpp>
#include <skein/ranks/communicator.hpp>

#include <vector>

namespace skein {

/// By all ranks. @returns what work_seconds says on each of them, on rank 0
std::vector<double> gather_work(Communicator& ranks);

/// By all ranks, where those that own the targets have the sum. @returns the sum at some targets, on rank 0
std::vector<Vec3> gather_sample(Communicator& ranks, const RankParts& owners, const FmmSum& sum,
                                const EvenSample& sample);

}  // namespace skein
