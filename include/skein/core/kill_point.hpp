#pragma once

#include <string_view>

namespace skein {

/// For tests: with SKEIN_TEST_KILL=<point>:<n> in the environment, the n-th call with that name ends the process with
/// SIGKILL, as a power cut would. Else it does nothing.
void reach_kill_point(std::string_view point);

}  // namespace skein
