#include "cli/check_text.hpp"

#include <skein/core/terminal_text.hpp>

#include <fmt/format.h>

namespace skein {

bool nothing_was_judged(const RunCheck& check) {
  return static_cast<std::size_t>(check.unreadable) == check.problems.size() && !check.problems.empty();
}

std::string describe_check(const RunCheck& check) {
  std::string text = fmt::format("status: {}\nframes: {}\nsteps: {}\nsegments: {}\ncheckpoints: {}\nlast time: {}\n",
                                 make_terminal_line(check.status), check.frames, check.records, check.segments,
                                 check.checkpoints, check.last_time);
  if (!check.parent.empty()) text += fmt::format("begun with the state of: {}\n", make_terminal_line(check.parent));
  const std::size_t n = check.problems.size();
  const char* plural = n == 1 ? "" : "s";
  if (nothing_was_judged(check)) return text + fmt::format("verdict: not known, {} problem{} of reading\n", n, plural);
  if (n > 0) return text + fmt::format("verdict: damaged, {} problem{}\n", n, plural);
  return text + fmt::format(
                    "certificate: {}\nnot looked at: trajectory.xdmf, logs, tables and pictures; no step was computed "
                    "again\nverdict: whole, no gap, no frame twice, unchanged since it was written\n",
                    make_terminal_line(check.checksum));
}

}  // namespace skein
