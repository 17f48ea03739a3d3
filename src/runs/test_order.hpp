#pragma once

#include <string>

namespace skein {

/// "name:number" of an environment variable by which tests ask a run for a fault; the number is 1 where none is given,
/// and 0 where the variable is not there.
struct TestOrder {
  std::string name;
  long number = 0;
};
TestOrder read_test_order(const char* variable);

/// With SKEIN_TEST_KILL=<milestone>:<n> in the environment, the n-th milestone of that name ends the process with
/// SIGKILL, as a power cut would.
void install_kill_order();

}  // namespace skein
