#include <skein/core/json.hpp>
#include <skein/core/terminal_text.hpp>
#include <skein/io/run_folder.hpp>
#include <skein/io/run_scene.hpp>
#include <skein/io/run_summary.hpp>
#include <skein/physics/mobility_choice.hpp>

#include "cli/common_arguments.hpp"
#include "cli/terminal.hpp"
#include "cli/verbs.hpp"

#include <fmt/format.h>

#include <cmath>
#include <memory>
#include <string>

namespace skein {
namespace {

struct InfoOptions {
  std::string folder;
  bool json = false;
};

void print_lines(const std::string& scene, const std::string& mobility, const RunSummary& summary) {
  print_result(fmt::format("title: {}\nstatus: {}\nscene: {}\nmobility: {}\nframes: {}\nsteps: {}\nsegments: {}\n",
                           make_terminal_line(summary.title), make_terminal_line(summary.status),
                           make_terminal_line(scene), mobility, summary.frames, summary.steps, summary.segments));
  if (std::isfinite(summary.last_time)) print_result(fmt::format("last time: {}\n", summary.last_time));
}

void print_json(const std::string& scene, const std::string& mobility, const RunSummary& summary) {
  JsonWriter json(/*n_open_levels=*/1);
  json.begin_object().member("title", summary.title).member("status", summary.status);
  json.member("scene", scene).member("mobility", mobility).member("frames", summary.frames);
  json.member("steps", summary.steps).member("segments", summary.segments).member("last_time", summary.last_time);
  print_result(json.end_object().take() + "\n");
}

int print_info(const InfoOptions& options) {
  const RunSummary summary = read_run_summary(options.folder);
  const RunFolder folder = RunFolder::open(options.folder);
  const std::string scene = folder.scene().string();
  const SceneConfig config = read_run_scene(folder);
  const std::string mobility = describe_choice(choose_mobility(config), config);
  options.json ? print_json(scene, mobility, summary) : print_lines(scene, mobility, summary);
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
