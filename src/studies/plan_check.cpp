#include "studies/plan_check.hpp"

#include <skein/core/error.hpp>
#include <skein/physics/scene_times.hpp>

#include "studies/plan_candidates.hpp"
#include "studies/reference_run.hpp"
#include "studies/rung.hpp"
#include "studies/rung_name.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

namespace skein {
namespace {

constexpr int n_checked_frames = 400;
constexpr double unlimited = std::numeric_limits<double>::infinity();

struct Measured {
  double error = 0.0, seconds = 0.0;
};

}  // namespace

std::vector<PlanCheck> check_plans(const SceneConfig& asked, const PlanRequest& request,
                                   const std::vector<double>& tolerances,
                                   const std::function<void(const std::string&)>& say) {
  SKEIN_REQUIRE(!tolerances.empty(), "a plan is for a tolerance");
  const SceneConfig scene = resolve_times(asked);
  SceneConfig finest = make_rung_scene(scene, finest_rung);
  finest.time.tolerance /= 3.0;
  say("the finest tube");
  const Pilot reference = run_reference(finest, n_checked_frames);
  const auto measure = [&](const SceneConfig& way) {
    const Pilot pilot = run_pilot(way, n_checked_frames, unlimited);
    const double error =
        pilot.failure.empty() ? find_largest_error(compare_answers(pilot, reference, request.asked)) : unlimited;
    return Measured{error, pilot.seconds};
  };
  // Each rung costs more than the one below, so that none need be run above the first that meets the tightest
  // tolerance.
  const double tightest = *std::min_element(tolerances.begin(), tolerances.end());
  std::vector<Measured> rungs;
  for (const Candidate& rung : list_candidates(scene)) {
    if (rung.is_barred) continue;
    say("pilot: " + describe_rung(rung.nodes_per_section));
    rungs.push_back(measure(rung.scene));
    say(fmt::format("its error is {:.2g} %, in {:.3g} s", 100.0 * rungs.back().error, rungs.back().seconds));
    if (rungs.back().error <= tightest) break;
  }
  std::vector<PlanCheck> checks;
  for (const double tolerance : tolerances) {
    PlanRequest once = request;
    once.tolerance = tolerance;
    const Plan plan = make_plan(scene, once, say);
    PlanCheck check{tolerance, std::nullopt, unlimited, unlimited, 0.0, unlimited};
    for (const Measured& rung : rungs)
      if (rung.error <= tolerance && rung.seconds < check.cheapest_seconds) check.cheapest_seconds = rung.seconds;
    if (plan.chosen >= 0) {
      const Candidate& chosen = plan.candidates[plan.chosen];
      const Measured found = measure(chosen.scene);
      check.chosen = chosen.nodes_per_section;
      check.predicted_error = chosen.error;
      check.measured_error = found.error;
      check.seconds = found.seconds;
    }
    checks.push_back(check);
  }
  return checks;
}

}  // namespace skein
