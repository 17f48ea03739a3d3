#pragma once

#include <skein/ranks/communicator.hpp>

#include <vector>

namespace skein {

/// By all ranks. @returns what work_seconds says on each of them, on rank 0
std::vector<double> gather_work(Communicator& ranks);

}  // namespace skein
