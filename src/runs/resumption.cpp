#include "runs/resumption.hpp"

#include <skein/core/version.hpp>
#include <skein/io/run_scene.hpp>

#include "runs/finished_run.hpp"
#include "runs/memory_limit.hpp"
#include "runs/prolong_run.hpp"

#include <fmt/format.h>

namespace skein {
namespace {

// What has to be said before going on; empty for a checkpoint of this very program.
std::string compare_programs(const Checkpoint& checkpoint) {
  if (checkpoint.text("program.commit") == commit() && checkpoint.text("program.version") == version()) return "";
  return fmt::format("the run was made by skein {} ({}), this is {} ({}): what follows may differ in the last digits",
                     checkpoint.text("program.version"), checkpoint.text("program.commit"), version(), commit());
}

std::string describe_point(const ResumePoint& point, const SceneConfig& scene) {
  if (!point.checkpoint)
    return fmt::format("resume: there is no checkpoint; the run starts at t = {:g}", scene.time.start);
  const double time = point.checkpoint->number("state.time"), span = scene.time.end - scene.time.start;
  return fmt::format("resume: from '{}', t = {:.6g}, step {}; {:.1f} % of the simulated time is done, {:.6g} is left",
                     point.path.string(), time, point.checkpoint->integer("state.step"),
                     span > 0.0 ? 100.0 * (time - scene.time.start) / span : 100.0, scene.time.end - time);
}

}  // namespace

Resumption prepare_resumption(const RunFolder& folder, const std::vector<std::string>& overrides,
                              const bool from_start) {
  const LaterEnd later = find_later_end(folder, overrides);
  Resumption run;
  run.point = find_resume_point(folder, from_start);
  move_end(folder, later);
  run.scene = read_run_scene(folder);
  check_memory(run.scene);
  for (const std::string& rejected : run.point.rejected) run.warnings += rejected + "\n";
  if (run.point.checkpoint && !is_at_end(run.scene, run.point)) run.warnings += compare_programs(*run.point.checkpoint);
  run.first_words =
      (later.text.empty() ? "" : later.description + "\n") + run.warnings + describe_point(run.point, run.scene);
  return run;
}

}  // namespace skein
