#include "runs/prolong_run.hpp"

#include <skein/core/error.hpp>
#include <skein/io/atomic_file.hpp>
#include <skein/io/read_file.hpp>
#include <skein/physics/scene_times.hpp>
#include <skein/scene/earlier_ends.hpp>
#include <skein/scene/scene_file.hpp>

#include <fmt/format.h>

namespace skein {
namespace {

/// Of two texts, the first lines that differ: "sections = 80" and "sections = 113".
std::string find_changed_line(const std::string& before, const std::string& after) {
  std::size_t start = 0;
  for (std::size_t i = 0; i < after.size() && i < before.size() && before[i] == after[i]; ++i)
    if (after[i] == '\n') start = i + 1;
  return after.substr(start, after.find('\n', start) - start);
}

void check_only_end_changes(const RunFolder& folder, SceneConfig scene, SceneConfig changed) {
  scene.time.earlier_ends.clear();
  changed.time.end = scene.time.end;
  const std::string before = write_scene(scene), after = write_scene(changed);
  if (before == after) return;
  throw Error(ExitCode::usage,
              fmt::format("a run that has begun keeps its scene: only time.end may become later, and this would be "
                          "changed, too: {}\n'skein run --from {} --set KEY=VALUE -o DIR' begins a new run with the "
                          "state that this one has reached",
                          find_changed_line(before, after), folder.path().string()));
}

}  // namespace

LaterEnd find_later_end(const RunFolder& folder, const std::vector<std::string>& overrides) {
  if (overrides.empty()) return {};
  const std::string name = folder.scene().string(), before = read_file(folder.scene());
  const SceneConfig scene = read_scene_text(before, name, {}).config;
  // The earlier ends are written here alone; beside an end that is too early they would be found wrong first.
  std::vector<std::string> changes{"time.earlier_ends=[]"};
  changes.insert(changes.end(), overrides.begin(), overrides.end());
  const SceneConfig changed = read_scene_text(before, name, changes).config;
  check_only_end_changes(folder, scene, changed);
  const double end = changed.time.end;
  if (end == scene.time.end) return {};
  if (end < scene.time.end)
    throw Error(ExitCode::usage,
                fmt::format("the run in '{0}' goes to t = {1}, and its end can only become later, not {2}; a file STOP "
                            "in the folder stops it, and 'skein run --from {0}@TIME -o DIR' begins a new run with one "
                            "of its frames",
                            folder.path().string(), scene.time.end, end));
  LaterEnd later{prolong_scene_text(before, end),
                 fmt::format("the run's end is moved from t = {:g} to {:g}", scene.time.end, end)};
  // What stands in the folder must serve the run: this is the last moment to find that it would not.
  resolve_times(read_scene_text(later.text, name, {}).config);
  return later;
}

void move_end(const RunFolder& folder, const LaterEnd& later) {
  if (!later.text.empty()) write_file_atomically(folder.scene(), later.text);
}

}  // namespace skein
