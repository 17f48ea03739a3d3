#include "harness.hpp"

#include <skein/arrays/runtime.hpp>

#include <cstdio>
#include <fstream>
#include <sstream>
#include <string>

namespace skein::perf {
namespace {

std::string processor() {
  std::ifstream cpuinfo("/proc/cpuinfo");
  for (std::string line; std::getline(cpuinfo, line);)
    if (line.rfind("model name", 0) == 0) return line.substr(line.find(':') + 2);
  return "unknown";
}

}  // namespace

void print_context() {
  std::printf("# processor: %s\n", processor().c_str());
  std::istringstream build(describe_build());
  for (std::string line; std::getline(build, line);) std::printf("# %s\n", line.c_str());
  std::printf("# device: %s\n", describe_backend().c_str());
}

}  // namespace skein::perf
