#include <skein/arrays/runtime.hpp>
#include <skein/core/duration.hpp>
#include <skein/core/version.hpp>
#include <skein/io/checkpoint_folder.hpp>
#include <skein/io/run_lock.hpp>
#include <skein/io/run_scene.hpp>

#include "cli/common_arguments.hpp"
#include "cli/terminal.hpp"
#include "cli/terminal_listener.hpp"
#include "cli/verbs.hpp"
#include "runs/finished_run.hpp"
#include "runs/memory_limit.hpp"
#include "runs/prolong_run.hpp"
#include "runs/run_control.hpp"
#include "runs/simulate.hpp"

#include <fmt/format.h>

#include <limits>
#include <memory>
#include <string>
#include <vector>

namespace skein {
namespace {

struct ResumeOptions {
  std::string folder;
  std::vector<std::string> overrides;
  int threads = 0;
  double max_walltime = std::numeric_limits<double>::infinity();
  bool from_start = false, quiet = false;
};

// What has to be said before going on; empty for a checkpoint of this very program.
std::string compare_programs(const Checkpoint& checkpoint) {
  std::string text;
  if (checkpoint.text("program.commit") != commit() || checkpoint.text("program.version") != version())
    text +=
        fmt::format("the run was made by skein {} ({}), this is {} ({}): what follows may differ in the last digits",
                    checkpoint.text("program.version"), checkpoint.text("program.commit"), version(), commit());
  return text;
}

std::string describe_point(const ResumePoint& point, const SceneConfig& scene) {
  if (!point.checkpoint)
    return fmt::format("resume: there is no checkpoint; the run starts at t = {:g}", scene.time.start);
  const double time = point.checkpoint->number("state.time"), span = scene.time.end - scene.time.start;
  return fmt::format("resume: from '{}', t = {:.6g}, step {}; {:.1f} % of the simulated time is done, {:.6g} is left",
                     point.path.string(), time, point.checkpoint->integer("state.step"),
                     span > 0.0 ? 100.0 * (time - scene.time.start) / span : 100.0, scene.time.end - time);
}

int finish_run(const RunFolder& folder, const SceneConfig& scene, const Checkpoint& checkpoint) {
  const std::string mended = mend_finished_run(scene, folder, checkpoint);
  if (!mended.empty()) print_warning(fmt::format("{}: mended", mended));
  print_message(fmt::format("'{}' is done: t = {:g}, step {}; nothing is left to do.", folder.path().string(),
                            scene.time.end, checkpoint.integer("state.step")));
  return 0;
}

int resume_run(const ResumeOptions& options) {
  const RunFolder folder = RunFolder::open_begun(options.folder);
  const Runtime runtime(options.threads);  // before anything is changed: there may be no such threads
  const RunLock lock(folder);
  if (!lock.note().empty()) print_warning(lock.note());
  const LaterEnd later = find_later_end(folder, options.overrides);
  const ResumePoint point = find_resume_point(folder, options.from_start);
  move_end(folder, later);
  const SceneConfig scene = read_run_scene(folder);
  check_memory(scene);
  const std::string first_words = later.text.empty() ? "" : later.description + "\n";
  std::string what_happened;
  for (const std::string& rejected : point.rejected) what_happened += rejected + "\n";
  if (is_at_end(scene, point)) {
    if (!what_happened.empty()) print_warning(what_happened);
    return finish_run(folder, scene, *point.checkpoint);
  }
  if (point.checkpoint) what_happened += compare_programs(*point.checkpoint);
  if (!what_happened.empty()) print_warning(what_happened);

  RunControl control(options.max_walltime);
  TerminalListener listener(options.quiet);
  return static_cast<int>(simulate(scene, folder, point.checkpoint ? &*point.checkpoint : nullptr, control, listener,
                                   first_words + what_happened + describe_point(point, scene)));
}

}  // namespace

Verb make_resume_verb() {
  const auto options = std::make_shared<ResumeOptions>();
  return {
      "resume",
      "Go on with a run that was stopped, killed or failed",
      {make_folder_argument(&options->folder),
       make_flag("--from-start", &options->from_start,
                 "Drop the frames of a run that has no good checkpoint, and start again at its beginning"),
       make_argument("--set", &options->overrides, "time.end=LATER", "Go on to a later end; no other key may change"),
       make_threads_option(&options->threads), make_walltime_option(&options->max_walltime),
       make_quiet_flag(&options->quiet)},
      "Examples:\n"
      "  skein resume tumbling\n"
      "  skein resume tumbling --max-walltime 8h --threads 2\n"
      "  skein resume tumbling --set time.end=24.0\n"
      "The run goes on from its newest good checkpoint to its end, "
      "and is equal in every bit to one that was\n"
      "never interrupted. A checkpoint that is damaged or cannot be read is named and an older one used. A run that\n"
      "has frames but no good checkpoint is left as it is, unless --from-start is given. One that is done is looked\n"
      "over, and its index written anew if that is missing, damaged or old.\n"
      "The exit code is 0 if the end was reached, 75 if the run was stopped again, 65 if no checkpoint is good, 74 if\n"
      "none can be read.",
      [options] { return resume_run(*options); }};
}

}  // namespace skein
