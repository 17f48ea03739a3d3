#include "runs/useful_threads.hpp"

#include <skein/arrays/default_path.hpp>
#include <skein/arrays/runtime.hpp>
#include <skein/scene/scene_size.hpp>

#include <fmt/format.h>

#include <algorithm>

namespace skein {
namespace {

constexpr double nodes_per_thread = 250.0;  ///< two tiles of direct sums, which play in pairs

}  // namespace

int count_useful_threads(const SceneConfig& scene) {
  if (default_path() == KernelPath::device) return most_host_threads;
  return static_cast<int>(std::clamp(count_scene_nodes(scene) / nodes_per_thread, 1.0, double{most_host_threads}));
}

std::string describe_threads(const SceneConfig& scene) {
  const HostThreads threads = host_threads();
  const double n_nodes = count_scene_nodes(scene);
  std::string text = fmt::format("threads: {}", threads.number);
  if (threads.number < threads.possible)
    return text +
           fmt::format(" of {}, because {:.0f} nodes keep no more busy; --threads or OMP_NUM_THREADS asks for more",
                       threads.possible, n_nodes);
  if (threads.asked_by.empty()) return text + ", all processors that this process may use";
  text += threads.asked_by == "--threads" ? ", as many as the run was given"
                                          : fmt::format(", as {} asks for", threads.asked_by);
  const int useful = count_useful_threads(scene);
  if (threads.number > useful) text += fmt::format("; {:.0f} nodes keep no more than {} busy", n_nodes, useful);
  return text;
}

}  // namespace skein
