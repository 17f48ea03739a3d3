#include "studies/plan.hpp"

#include <skein/core/error.hpp>
#include <skein/physics/scene_times.hpp>

#include "runs/known_contact.hpp"
#include "studies/ladder_reach.hpp"
#include "studies/ladder_table.hpp"
#include "studies/plan_by_table.hpp"
#include "studies/plan_candidates.hpp"
#include "studies/plan_climb.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

namespace skein {
namespace {

/// What is left to say of every candidate once one is chosen, or none.
void finish(Plan& plan, const PlanPilots& pilots) {
  estimate_seconds(plan.candidates);
  for (std::size_t i = 0; i < plan.candidates.size(); ++i) {
    Candidate& candidate = plan.candidates[i];
    const int place = static_cast<int>(i) - plan.chosen;
    if (place == 0) candidate.verdict = "chosen";
    if (candidate.verdict.empty()) candidate.verdict = plan.chosen >= 0 && place > 0 ? "dearer" : "not looked at";
    if (std::isnan(candidate.error)) candidate.error = find_ladder_error(candidate.nodes_per_section);
  }
  plan.seconds = pilots.seconds();
  plan.reason = explain_choice(plan, pilots.request());
}

std::optional<Pilot> choose_by_pilots(const SceneConfig& scene, PlanPilots& pilots, Plan& plan) {
  // Rigid fibers have steps of their own, whose errors say nothing of those that bend.
  const auto coarsest = std::find_if(plan.candidates.begin(), plan.candidates.end(),
                                     [](const Candidate& candidate) { return candidate.bends(); });
  constexpr double finest = 0.3;  // of the scene's time tolerance
  StepChoice steps =
      choose_steps(pilots, *coarsest, scene, finest * scene.time.tolerance, std::numeric_limits<double>::infinity());
  plan.time_tolerance = steps.time_tolerance;
  plan.time_error = steps.error;
  for (Candidate& candidate : plan.candidates) candidate.scene.time.tolerance = plan.time_tolerance;
  const auto first = static_cast<std::size_t>(coarsest - plan.candidates.begin());
  return climb_ladder(scene, pilots, plan, first, std::move(steps.pilot));
}

}  // namespace

Plan make_plan(const SceneConfig& asked, const PlanRequest& request,
               const std::function<void(const std::string&)>& say) {
  SKEIN_REQUIRE(request.tolerance > 0.0, "a tolerance is positive");
  const SceneConfig scene = resolve_times(asked);
  PlanPilots pilots(scene.time.end, request, say);
  Plan plan;
  plan.end = plan.pilot_end = scene.time.end;
  plan.known_contact = describe_known_contact(scene);
  plan.candidates = list_candidates(scene);
  std::optional<Pilot> chosen;
  if (const auto reach = find_ladder_reach(scene, request.asked)) chosen = choose_by_table(scene, *reach, pilots, plan);
  if (plan.chosen < 0) chosen = choose_by_pilots(scene, pilots, plan);
  if (plan.chosen >= 0 && chosen && chosen->is_whole())
    plan.variants = try_variants(pilots, scene, *chosen, plan.candidates[plan.chosen]);
  finish(plan, pilots);
  return plan;
}

}  // namespace skein
