#include <skein/core/json.hpp>
#include <skein/physics/mobility_choice.hpp>
#include <skein/scene/scene_file.hpp>

#include "cli/common_arguments.hpp"
#include "cli/terminal.hpp"
#include "cli/verbs.hpp"
#include "runs/known_contact.hpp"
#include "runs/placed_scene.hpp"
#include "runs/scene_summary.hpp"
#include "studies/ladder_table.hpp"

#include <fmt/format.h>

#include <memory>
#include <string>
#include <vector>

namespace skein {
namespace {

struct ValidateOptions {
  std::string scene;
  std::vector<std::string> overrides;
  bool json = false;
};

void write_problems(JsonWriter& json, const std::string& name, const std::vector<Problem>& problems) {
  json.key(name).begin_array();
  for (const Problem& problem : problems) {
    json.begin_object().member("source", problem.where.source).member("line", problem.where.line);
    json.member("column", problem.where.column).member("message", problem.message);
    json.member("key", problem.key_doc).end_object();
  }
  json.end_array();
}

void print_json(const bool valid, const std::vector<Problem>& problems, const std::vector<Problem>& warnings) {
  constexpr int n_open_levels = 2;  // of the report and its lists
  JsonWriter json(n_open_levels);
  json.begin_object().member("valid", valid);
  write_problems(json, "problems", problems);
  write_problems(json, "warnings", warnings);
  print_result(json.end_object().take() + "\n");
}

int validate_scene(const ValidateOptions& options) {
  PlacedScene scene;
  try {
    scene = read_placed_scene(options.scene, options.overrides);
  } catch (const SceneError& error) {
    if (!options.json) throw;
    print_json(false, error.problems(), {});
    return static_cast<int>(error.code());
  }
  if (options.json) {
    print_json(true, {}, scene.warnings);
    return 0;
  }
  for (const Problem& warning : scene.warnings) print_warning(warning.describe());
  print_result(fmt::format("{}mobility: {}\n{}\n{}\n", describe_scene(scene.config),
                           describe_choice(choose_mobility(scene.config), scene.config), describe_ladder(),
                           describe_known_contact(scene.config)));
  return 0;
}

}  // namespace

Verb make_validate_verb() {
  const auto options = std::make_shared<ValidateOptions>();
  return {"validate",
          "Look for mistakes in a scene, and print what follows from it",
          {make_scene_argument(&options->scene), make_overrides_option(&options->overrides),
           make_flag("--json", &options->json, "Problems and warnings as JSON on stdout")},
          "Examples:\n"
          "  skein validate configs/tumbling.toml\n"
          "  skein validate configs/tumbling.toml --set fiber.sections=113 --json\n"
          "The exit code is 0 for a valid scene, 78 for a wrong one, 66 if there is none.",
          [options] { return validate_scene(*options); }};
}

}  // namespace skein
