#include <skein/arrays/runtime.hpp>
#include <skein/core/error.hpp>
#include <skein/io/atomic_file.hpp>
#include <skein/scene/scene_file.hpp>

#include "cli/common_arguments.hpp"
#include "cli/terminal.hpp"
#include "cli/verbs.hpp"
#include "runs/placed_scene.hpp"
#include "studies/plan.hpp"

#include <fmt/format.h>

#include <filesystem>
#include <memory>
#include <sstream>
#include <string>
#include <vector>

namespace skein {
namespace {

struct PlanOptions {
  std::string scene, asked;
  std::vector<std::string> overrides;
  std::filesystem::path output;  ///< for the planned scene; empty: none
  PlanRequest request;
  int threads = 0;
  bool json = false, quiet = false;
};

std::vector<Question> split_questions(const std::string& asked) {
  std::vector<Question> questions;
  std::istringstream words(asked);
  for (std::string word; std::getline(words, word, ',');) questions.push_back(find_question(word));
  return questions;
}

void write_planned(const std::filesystem::path& path, const SceneConfig& scene) {
  AtomicFile file(path);
  file.write(write_readable_scene(scene));
  file.commit();
}

int plan_scene(PlanOptions& options) {
  if (!options.asked.empty()) options.request.asked = split_questions(options.asked);
  const PlacedScene placed = read_placed_scene(options.scene, options.overrides);
  if (!options.quiet && !placed.warnings.empty()) print_warning(describe_problems(placed.warnings));
  const Runtime runtime(options.threads);
  const Plan plan = make_plan(placed.config, options.request, [&](const std::string& words) {
    if (!options.quiet) print_note(words);
  });
  print_result(options.json ? describe_plan_as_json(plan, options.request) : describe_plan(plan, options.request));
  if (plan.chosen < 0) return static_cast<int>(ExitCode::numerical);
  if (!options.output.empty()) write_planned(options.output, plan.candidates[plan.chosen].scene);
  return 0;
}

}  // namespace

Verb make_plan_verb() {
  const auto options = std::make_shared<PlanOptions>();
  return {
      "plan",
      "Find the cheapest model that answers a scene's questions well enough",
      {make_scene_argument(&options->scene),
       make_argument("--tolerance", &options->request.tolerance, "",
                     "Relative error of each answer; shapes: over the fiber's length")
           .within(1e-4, 0.5),
       make_argument("--for", &options->asked, "WORDS",
                     "What is asked, between commas: shape, half_period, hook_radius, snaking_speed, curvature_max, "
                     "contact: how deep surfaces are pressed into each other, over the radius (default: the first "
                     "four; in none may fibers pass through each other)"),
       make_argument("--within", Duration{&options->request.max_seconds}, "T",
                     "Wall time for pilot runs: seconds, 30m, 2h or 1:30:00"),
       make_argument("-o,--output", &options->output, "FILE", "Write the planned scene"),
       make_overrides_option(&options->overrides), make_threads_option(&options->threads),
       make_flag("--json", &options->json, "The table as JSON"), make_quiet_flag(&options->quiet)},
      "Examples:\n"
      "  skein plan configs/lagrone2019_L0523.toml --tolerance 0.03\n"
      "  skein plan configs/tumbling.toml --tolerance 0.01 --for half_period -o cheap.toml\n"
      "Rigid fibers, chains and tubes of fewer nodes on a section keep length, radius and what they are to the fluid,\n"
      "all but the first the rigidity, too. From the first of them on, each is run and compared with a finer one,\n"
      "until their difference says that it is good enough.\n"
      "The exit code is 0 if one is, 76 if none is.",
      [options] { return plan_scene(*options); }};
}

}  // namespace skein
