#include <skein/core/error.hpp>
#include <skein/io/run_check.hpp>

#include "cli/check_text.hpp"
#include "cli/common_arguments.hpp"
#include "cli/terminal.hpp"
#include "cli/verbs.hpp"

#include <memory>
#include <string>

namespace skein {
namespace {

int verify_run(const std::string& folder) {
  const RunCheck check = check_run(folder);
  for (const std::string& problem : check.problems) print_error(problem);
  for (const std::string& note : check.notes) print_note(note);
  print_result(describe_check(check));
  if (check.problems.empty()) return 0;
  return static_cast<int>(nothing_was_judged(check) ? ExitCode::io_error : ExitCode::damaged_data);
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
