#include "cli/common_options.hpp"

#include <skein/core/duration.hpp>

#include <CLI/CLI.hpp>

#include <string>

namespace skein {
namespace {

constexpr int n_threads_allowed = 4096;

std::string check_duration(const std::string& text) {
  if (parse_duration(text)) return "";
  return "'" + text + "' is no duration; write seconds, or 90s, 30m, 2h, 1d, 1:30:00";
}

}  // namespace

void add_threads_option(CLI::App& verb, int& threads) {
  verb.add_option("--threads", threads, "Threads of the host (default: OMP_NUM_THREADS or all cores)")
      ->type_name("N")
      ->check(CLI::Range(1, n_threads_allowed));
}

void add_walltime_option(CLI::App& verb, double& seconds) {
  verb.add_option_function<std::string>(
          "--max-walltime", [&seconds](const std::string& text) { seconds = *parse_duration(text); },
          "Stop in time, with a checkpoint: seconds, 30m, 2h or 1:30:00")
      ->type_name("T")
      ->check(check_duration);
}

}  // namespace skein
