#pragma once

#include <skein/arrays/types.hpp>

#include <functional>

namespace skein {

/// For tests of runs that ranks share: with SKEIN_TEST_RANK=<fault>:<n> in the environment of a rank that serves,
/// something happens to it from the n-th sum on that it has a part in: it throws ("throw"), sleeps for ever ("sleep"),
/// computes for ever
/// ("spin"), or its forces are not numbers ("nan"). A file `rank_fault` in the current folder tells when. Empty without
/// it.
std::function<void(const Vectors& force)> read_rank_fault();

}  // namespace skein
