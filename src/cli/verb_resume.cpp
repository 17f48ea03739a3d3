#include <skein/arrays/runtime.hpp>
#include <skein/core/duration.hpp>
#include <skein/core/error.hpp>
#include <skein/io/run_lock.hpp>
#include <skein/io/run_scene.hpp>

#include "cli/common_arguments.hpp"
#include "cli/terminal.hpp"
#include "cli/terminal_listener.hpp"
#include "cli/verbs.hpp"
#include "mpi/launch.hpp"
#include "runs/finished_run.hpp"
#include "runs/resumption.hpp"
#include "runs/run_control.hpp"
#include "runs/shared_run.hpp"
#include "runs/simulate.hpp"
#include "runs/useful_threads.hpp"

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

int finish_run(const RunFolder& folder, const SceneConfig& scene, const Checkpoint& checkpoint) {
  const std::string mended = mend_finished_run(scene, folder, checkpoint);
  if (!mended.empty()) print_warning(fmt::format("{}: mended", mended));
  print_message(fmt::format("'{}' is done: t = {:g}, step {}; nothing is left to do.", folder.path().string(),
                            scene.time.end, checkpoint.integer("state.step")));
  return 0;
}

/// All where the scene cannot be read, which is told in its turn.
int count_useful_threads_of(const RunFolder& folder) {
  try {
    return count_useful_threads(read_run_scene(folder));
  } catch (const Error&) {
    return most_host_threads;
  }
}

int resume_run(const ResumeOptions& options, Communicator* ranks) {
  const RunFolder folder = RunFolder::open_begun(options.folder);
  // Before anything is changed: there may be no such threads.
  const Runtime runtime(options.threads, count_useful_threads_of(folder));
  const RunLock lock(folder);
  if (!lock.note().empty()) print_warning(lock.note());
  const Resumption run = prepare_resumption(folder, options.overrides, options.from_start);
  if (!run.warnings.empty()) print_warning(run.warnings);
  if (is_at_end(run.scene, run.point)) return finish_run(folder, run.scene, *run.checkpoint());

  RunControl control(options.max_walltime);
  TerminalListener listener(options.quiet);
  return static_cast<int>(simulate(run.scene, folder, run.checkpoint(), control, listener, run.first_words, ranks));
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
      "  mpirun -n 4 skein resume tumbling\n"
      "The run goes on from its newest good checkpoint to its end, "
      "and is equal in every bit to one that was\n"
      "never interrupted. A checkpoint that is damaged or cannot be read is named and an older one used. A run that\n"
      "has frames but no good checkpoint is left as it is, unless --from-start is given. One that is done is looked\n"
      "over, and its index written anew if that is missing, damaged or old.\n"
      "The exit code is 0 if the end was reached, 75 if the run was stopped again, 65 if no checkpoint is good, 74 if\n"
      "none can be read.",
      [options] {
        options->threads = share_threads(options->threads);
        return share_run(join_ranks(), options->threads,
                         [&](Communicator* ranks) { return resume_run(*options, ranks); });
      },
      /*takes_ranks=*/true};
}

}  // namespace skein
