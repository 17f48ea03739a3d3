#include "studies/ladder_reach.hpp"

#include "runs/fiber_in_shear.hpp"
#include "studies/ladder_table.hpp"
#include "studies/paper_scenes.hpp"
#include "studies/rung.hpp"
#include "studies/rung_name.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace skein {
namespace {

constexpr double not_in_table = std::numeric_limits<double>::quiet_NaN();
constexpr double closeness = 0.02;

bool are_close(const double a, const double b) { return std::abs(a - b) <= closeness * std::abs(b); }

/// The value of a rung, by what the table's runs of one length have. @param value  called with a run
template <class Value>
double interpolate(const double length, const int rung, const Value& value) {
  const LadderRun *below = nullptr, *above = nullptr;
  for (const LadderRun& run : list_ladder_runs()) {
    if (run.length != length) continue;
    const int nodes = run.nodes_per_section;
    if (nodes <= rung && (!below || nodes > below->nodes_per_section)) below = &run;
    if (nodes >= rung && (!above || nodes < above->nodes_per_section)) above = &run;
  }
  if (!below || !above) return not_in_table;
  if (below == above) return value(*below);
  const double share = (1.0 * rung - below->nodes_per_section) / (above->nodes_per_section - below->nodes_per_section);
  return (1.0 - share) * value(*below) + share * value(*above);
}

/// The rung of the table that comes next below the finest.
int find_second_finest() {
  int second = 0;
  for (const LadderRun& run : list_ladder_runs())
    if (run.nodes_per_section < finest_rung) second = std::max(second, run.nodes_per_section);
  return second;
}

/// The same fiber in the paper's units, as the rung that the scene has.
bool is_rung_of(const SceneConfig& paper, const FiberConfig& fiber, const FiberInShear& shear) {
  const int rung = find_rung(fiber);
  if (rung < chain_rung + 1) return false;
  const SceneConfig expected = make_rung_scene(paper, rung);
  const auto expected_shear = find_fiber_in_shear(expected);
  const FiberConfig& other = expected.fibers.front();
  return expected_shear && are_close(shear.aspect_ratio, expected_shear->aspect_ratio) &&
         are_close(shear.stiffness, expected_shear->stiffness) &&
         are_close(fiber.blob / fiber.radius, other.blob / other.radius) &&
         are_close(1.0 * fiber.sections, 1.0 * other.sections) && fiber.reach_along == other.reach_along &&
         fiber.reach_around == other.reach_around;
}

}  // namespace

std::vector<AnswerError> LadderReach::list_errors(const int nodes_per_section) const {
  const int rung = std::min(nodes_per_section, finest_rung), second = find_second_finest();
  std::vector<AnswerError> found;
  for (const Question question : asked) {
    const auto& all = list_questions();
    const auto column = static_cast<std::size_t>(std::find(all.begin(), all.end(), question) - all.begin());
    const auto error_of = [&](const LadderRun& run) { return run.errors[column]; };
    const double next_error = interpolate(length, second, error_of);
    const double error = interpolate(length, rung, [&](const LadderRun& run) {
      return run.nodes_per_section == finest_rung ? 0.5 * next_error : error_of(run);
    });
    if (!std::isnan(error)) found.push_back({question, error});
  }
  return found;
}

double LadderReach::find_error(const int nodes_per_section) const {
  if (nodes_per_section < chain_rung) return not_in_table;
  return find_largest_error(list_errors(nodes_per_section));
}

double LadderReach::find_seconds(const int nodes_per_section) const {
  return interpolate(length, std::min(nodes_per_section, finest_rung),
                     [](const LadderRun& run) { return run.seconds; });
}

// Changes an answer by less than 1e-4, where rungs differ by 1e-3 (docs/hydrodynamics.md, "What a run's tolerance is
// worth").
constexpr double usual_sum_tolerance = 1e-4;

std::optional<LadderReach> find_ladder_reach(const SceneConfig& scene, const std::vector<Question>& asked) {
  if (scene.repulsion.strength > 0.0 || scene.time.step > 0.0 || scene.time.start != 0.0) return std::nullopt;
  if (std::find(asked.begin(), asked.end(), Question::contact) != asked.end()) return std::nullopt;
  const auto shear = find_fiber_in_shear(scene);
  if (!shear || scene.hydrodynamics.tolerance > usual_sum_tolerance) return std::nullopt;
  const FiberConfig& fiber = scene.fibers.front();
  constexpr double aligned = 1.0 - 1e-9;
  if (fiber.start_amplitude > 0.0 || fiber.start_noise > 0.0 ||
      std::abs(fiber.direction.x) < aligned * norm(fiber.direction))
    return std::nullopt;
  for (const LadderRun& run : list_ladder_runs()) {
    if (run.nodes_per_section != finest_rung) continue;
    const double end = find_ladder_end(run.length);
    const SceneConfig paper = make_paper_scene(count_paper_sections(run.length), end);
    const double time = paper.flows.front().rate / shear->rate;  // of the scene, that one of the paper's is
    constexpr double least_share = 0.8, rounding = 1e-9, usual_tolerance = 1e-4;
    if (scene.time.end < least_share * end * time || scene.time.end > (1.0 + rounding) * end * time) continue;
    if (scene.time.tolerance > (1.0 + rounding) * usual_tolerance / time) continue;
    if (!is_rung_of(paper, fiber, *shear)) continue;
    return LadderReach{run.length, ladder_time_tolerance / time, asked};
  }
  return std::nullopt;
}

}  // namespace skein
