#include "runs/memory_limit.hpp"

#include <skein/core/resource_error.hpp>
#include <skein/scene/scene_size.hpp>

#include <fmt/format.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <fstream>
#include <limits>
#include <string>

namespace skein {
namespace {

// The least that was measured: the largest resident memory of `skein run --dry-run` with 18 nodes a section is 860
// bytes a node at 1e5 nodes and 730 at 3e5, of a run by RKC2 with 6 a section 1500. TR-BDF2's factors take ten times as
// much.
constexpr double bytes_per_node = 700.0;

/// The number in a file of the control groups; infinity where there is none, or the word "max".
double read_limit(const std::string& path) {
  double bytes = 0.0;
  std::ifstream file(path);
  return file >> bytes ? bytes : std::numeric_limits<double>::infinity();
}

/// Each group is within its parents, and the smallest limit of all counts.
double find_group_limit() {
  double limit = read_limit("/sys/fs/cgroup/memory/memory.limit_in_bytes");
  std::ifstream groups("/proc/self/cgroup");
  for (std::string line; std::getline(groups, line);) {
    const bool is_unified = line.starts_with("0::"), is_of_memory = line.find(":memory:") != std::string::npos;
    if (!is_unified && !is_of_memory) continue;
    const std::string root = is_unified ? "/sys/fs/cgroup" : "/sys/fs/cgroup/memory";
    const std::string name = is_unified ? "/memory.max" : "/memory.limit_in_bytes";
    for (std::string group = line.substr(line.rfind(':') + 1);; group.resize(group.rfind('/'))) {
      limit = std::min(limit, read_limit(root + group + name));
      if (group.find('/') == std::string::npos) break;
    }
  }
  return limit;
}

}  // namespace

double estimate_memory(const SceneConfig& scene) { return bytes_per_node * count_scene_nodes(scene); }

double find_memory_limit() {
  double limit = static_cast<double>(::sysconf(_SC_PHYS_PAGES)) * static_cast<double>(::sysconf(_SC_PAGESIZE));
  for (const auto kind : {RLIMIT_AS, RLIMIT_DATA}) {
    rlimit own{};
    if (::getrlimit(kind, &own) == 0 && own.rlim_cur != RLIM_INFINITY)
      limit = std::min(limit, static_cast<double>(own.rlim_cur));
  }
  return std::min(limit, find_group_limit());
}

void check_memory(const SceneConfig& scene) {
  const double needed = estimate_memory(scene), limit = find_memory_limit();
  if (needed <= limit) return;
  throw ResourceError(
      fmt::format("the scene's nodes take at least {:.3g} GB of memory, and this process can have {:.3g} "
                  "GB. Use fewer or shorter fibers, fewer nodes_per_section, or a machine with more.",
                  1e-9 * needed, 1e-9 * limit));
}

}  // namespace skein
