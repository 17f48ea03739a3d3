#pragma once

#include <skein/io/run_check.hpp>

#include <string>

namespace skein {

/// True where all problems are of reading, so that nothing is known to be damaged.
bool nothing_was_judged(const RunCheck& check);

/// What a run holds, its certificate and the verdict: lines of "key: value".
std::string describe_check(const RunCheck& check);

}  // namespace skein
