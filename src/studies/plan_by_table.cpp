#include "studies/plan_by_table.hpp"

#include "studies/plan_candidates.hpp"
#include "studies/rung_name.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace skein {
namespace {

using Candidates = std::vector<Candidate>;

/// The first of the candidates that is good enough, or a rung between it and the one below, which joins them; their
/// end: none.
Candidates::iterator find_rung_in(const SceneConfig& scene, const LadderReach& reach, const double tolerance,
                                  Candidates& candidates) {
  const auto found = std::find_if(candidates.begin(), candidates.end(), [&](const Candidate& candidate) {
    return candidate.bends() && reach.find_error(candidate.nodes_per_section) <= tolerance;
  });
  if (found == candidates.begin() || found == candidates.end()) return found;
  const int below = std::prev(found)->nodes_per_section;
  constexpr double most_of_tolerance = 0.9;  // the rest is for steps, and for what the table does not have
  for (int rung = below + 1; below > chain_rung && rung < found->nodes_per_section; ++rung) {
    if (!(reach.find_error(rung) <= most_of_tolerance * tolerance)) continue;
    Candidate between = make_candidate(scene, rung);
    if (!between.is_barred) return candidates.insert(found, std::move(between));
  }
  return found;
}

/// On which candidate steps are chosen: the finest, up to the chosen one, that is cheap beside the time for pilots.
const Candidate& find_step_rung(const LadderReach& reach, const double max_seconds, const Candidates& candidates,
                                const std::size_t chosen) {
  constexpr double most_share = 0.02;  // of five pilots each
  const Candidate* rung = nullptr;
  for (std::size_t i = 0; i <= chosen; ++i) {
    const Candidate& candidate = candidates[i];
    const bool is_cheap = reach.find_seconds(candidate.nodes_per_section) <= most_share * max_seconds;
    if (candidate.bends() && (is_cheap || !rung)) rung = &candidate;
  }
  return *rung;
}

/// Errors by the table, and wall times by it and by one pilot.
void fill_in(const LadderReach& reach, const Candidate& piloted, const StepChoice& steps, Candidates& candidates) {
  const double here = steps.pilot ? steps.pilot->seconds / reach.find_seconds(piloted.nodes_per_section) : 1.0;
  for (Candidate& candidate : candidates) {
    if (!candidate.bends()) continue;
    candidate.scene.time.tolerance = steps.time_tolerance;
    candidate.error = reach.find_error(candidate.nodes_per_section) + steps.error;
    candidate.seconds = here * reach.find_seconds(candidate.nodes_per_section);
  }
}

}  // namespace

std::optional<Pilot> choose_by_table(const SceneConfig& scene, const LadderReach& reach, PlanPilots& pilots,
                                     Plan& plan) {
  const double tolerance = pilots.request().tolerance;
  const Candidates before = plan.candidates;
  const auto found = find_rung_in(scene, reach, tolerance, plan.candidates);
  if (found == plan.candidates.end()) return std::nullopt;
  const auto chosen = static_cast<std::size_t>(found - plan.candidates.begin());
  const Candidate& step_rung = find_step_rung(reach, pilots.request().max_seconds, plan.candidates, chosen);
  StepChoice steps = choose_steps(pilots, step_rung, scene, reach.time_tolerance,
                                  tolerance - reach.find_error(found->nodes_per_section));
  fill_in(reach, step_rung, steps, plan.candidates);
  std::optional<Pilot> pilot;
  constexpr double share_of_rest = 0.5;
  if (&step_rung == &*found)
    pilot = std::move(steps.pilot);
  else if (found->seconds <= share_of_rest * pilots.seconds_left())
    pilot = pilots.run(found->scene, describe_rung(found->nodes_per_section));
  if (pilot && !note_pilot(scene, pilots, plan, *found, *pilot)) {
    plan.candidates = before;
    return std::nullopt;
  }
  for (std::size_t i = 0; i <= chosen; ++i) {
    Candidate& candidate = plan.candidates[i];
    if (!candidate.bends()) continue;
    candidate.found = reach.list_errors(candidate.nodes_per_section);
    candidate.compared_with = finest_rung;
    Question worst = Question::shape;
    find_largest_error(candidate.found, &worst);
    if (i < chosen) candidate.verdict = fmt::format("{} fails", name_of(worst));
  }
  plan.chosen = static_cast<int>(chosen);
  plan.is_by_table = true;
  plan.time_tolerance = steps.time_tolerance;
  plan.time_error = steps.error;
  return pilot;
}

}  // namespace skein
