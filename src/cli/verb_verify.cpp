#include <skein/core/error.hpp>
#include <skein/core/terminal_text.hpp>
#include <skein/io/run_check.hpp>

#include "cli/common_arguments.hpp"
#include "cli/terminal.hpp"
#include "cli/verbs.hpp"

#include <fmt/format.h>

#include <memory>
#include <string>

namespace skein {
namespace {

int verify_run(const std::string& folder) {
  const RunCheck check = check_run(folder);
  for (const std::string& problem : check.problems) print_error(problem);
  for (const std::string& note : check.notes) print_note(note);
  print_result(fmt::format("status: {}\nframes: {}\nsteps: {}\nsegments: {}\ncheckpoints: {}\nlast time: {}\n",
                           make_terminal_line(check.status), check.frames, check.records, check.segments,
                           check.checkpoints, check.last_time));
  if (!check.parent.empty())
    print_result(fmt::format("begun with the state of: {}\n", make_terminal_line(check.parent)));
  if (!check.problems.empty()) {
    const auto n_unreadable = static_cast<std::size_t>(check.unreadable);
    const char* plural = check.problems.size() == 1 ? "" : "s";
    if (n_unreadable == check.problems.size()) {
      print_result(fmt::format("verdict: not known, {} problem{} of reading\n", n_unreadable, plural));
      return static_cast<int>(ExitCode::io_error);
    }
    print_result(fmt::format("verdict: damaged, {} problem{}\n", check.problems.size(), plural));
    return static_cast<int>(ExitCode::damaged_data);
  }
  print_result(
      fmt::format("certificate: {}\nnot looked at: trajectory.xdmf, logs, tables and pictures; no step was computed "
                  "again\nverdict: whole, no gap, no frame twice, unchanged since it was written\n",
                  make_terminal_line(check.checksum)));
  return 0;
}

}  // namespace

Verb make_verify_verb() {
  const auto folder = std::make_shared<std::string>();
  return {"verify",
          "Prove that a run is whole, or say what is wrong where",
          {make_folder_argument(folder.get())},
          "Examples:\n"
          "  skein verify tumbling\n"
          "Checked are all checksums of frames, step records and checkpoints, "
          "their chain from the scene to the last frame,\n"
          "the frames' times, and that times are sums of the steps. The exit code is 0, 65 if anything is damaged, or "
          "74 if\n"
          "something cannot be read, and nothing that could be is damaged.",
          [folder] { return verify_run(*folder); }};
}

}  // namespace skein
