#include <skein/core/json.hpp>
#include <skein/core/terminal_text.hpp>
#include <skein/io/read_file.hpp>
#include <skein/io/run_folder.hpp>
#include <skein/io/run_scene.hpp>
#include <skein/io/run_summary.hpp>
#include <skein/physics/mobility_choice.hpp>

#include "cli/common_arguments.hpp"
#include "cli/terminal.hpp"
#include "cli/verbs.hpp"

#include <fmt/format.h>

#include <cmath>
#include <filesystem>
#include <memory>
#include <string>
#include <system_error>

namespace skein {
namespace {

struct InfoOptions {
  std::string folder;
  bool json = false;
};

/// The last line of the log that begins with this mark, after its time, from there on. @param otherwise  where there is
/// none
std::string find_in_log(const RunFolder& folder, const std::string& mark, const std::string& otherwise) {
  std::error_code ignored;
  if (!std::filesystem::is_regular_file(folder.run_log(), ignored)) return "not known";
  const std::string log = read_file(folder.run_log());
  const std::size_t last = log.rfind(mark);
  if (last == std::string::npos) return otherwise;
  const std::size_t first = last + mark.size();
  return log.substr(first, log.find('\n', first) - first);
}

/// What the scene, the log and its folder say of a run, beside the summary of its trajectory.
struct RunWords {
  std::string scene, mobility, ranks, threads;
};

void print_lines(const RunWords& words, const RunSummary& summary) {
  print_result(fmt::format(
      "title: {}\nstatus: {}\nscene: {}\nmobility: {}\nranks: {}\nthreads: {}\nframes: {}\nsteps: {}\nsegments: {}\n",
      make_terminal_line(summary.title), make_terminal_line(summary.status), make_terminal_line(words.scene),
      words.mobility, make_terminal_line(words.ranks), make_terminal_line(words.threads), summary.frames, summary.steps,
      summary.segments));
  if (std::isfinite(summary.last_time)) print_result(fmt::format("last time: {}\n", summary.last_time));
}

void print_json(const RunWords& words, const RunSummary& summary) {
  JsonWriter json(/*n_open_levels=*/1);
  json.begin_object().member("title", summary.title).member("status", summary.status);
  json.member("scene", words.scene).member("mobility", words.mobility).member("ranks", words.ranks);
  json.member("threads", words.threads)
      .member("frames", summary.frames)
      .member("steps", summary.steps)
      .member("segments", summary.segments)
      .member("last_time", summary.last_time);
  print_result(json.end_object().take() + "\n");
}

int print_info(const InfoOptions& options) {
  const RunSummary summary = read_run_summary(options.folder);
  const RunFolder folder = RunFolder::open(options.folder);
  const SceneConfig config = read_run_scene(folder);
  const RunWords words{folder.scene().string(), describe_choice(choose_mobility(config), config),
                       find_in_log(folder, " s  ranks: ", "none, the run has one process"),
                       find_in_log(folder, " s  threads: ", "not known")};
  options.json ? print_json(words, summary) : print_lines(words, summary);
  return 0;
}

}  // namespace

Verb make_info_verb() {
  const auto options = std::make_shared<InfoOptions>();
  return {"info",
          "Say what a run folder holds",
          {make_folder_argument(&options->folder), make_flag("--json", &options->json, "As JSON")},
          "Examples:\n"
          "  skein info tumbling\n"
          "  skein info tumbling --json",
          [options] { return print_info(*options); }};
}

}  // namespace skein
