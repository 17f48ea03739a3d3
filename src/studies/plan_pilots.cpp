#include "studies/plan_pilots.hpp"

#include "studies/rung_name.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace skein {
namespace {

constexpr int n_intervals = 400;  ///< of a pilot's frames: snaking is measured in a few units of time

}  // namespace

PlanPilots::PlanPilots(const double end, const PlanRequest& request, const std::function<void(const std::string&)>& say)
    : end_(end), request_(request), say_(say) {}

bool PlanPilots::asks_contact() const {
  return std::find(request_.asked.begin(), request_.asked.end(), Question::contact) != request_.asked.end();
}

std::optional<Pilot> PlanPilots::run(const SceneConfig& scene, const std::string& words, const double max_seconds) {
  const double seconds = std::min(seconds_left(), max_seconds);
  if (seconds <= 0.0) return std::nullopt;
  say_("pilot: " + words);
  Pilot pilot = run_pilot(scene, n_intervals, seconds);
  constexpr double least_share = 0.1;
  if (pilot.end() < least_share * end_) return std::nullopt;
  if (pilot.is_late && asks_contact()) return std::nullopt;  // surfaces may meet at any time
  return pilot;
}

StepChoice choose_steps(PlanPilots& pilots, const Candidate& candidate, const SceneConfig& scene, const double finest,
                        const double room) {
  StepChoice choice;
  choice.time_tolerance = std::isfinite(room) ? finest : scene.time.tolerance;
  if (scene.time.step > 0.0) return choice;  // the scene says how long they are
  SceneConfig tried = candidate.scene;
  const auto pilot_at = [&](const double tolerance) {
    tried.time.tolerance = tolerance;
    return pilots.run(tried, fmt::format("{}, time.tolerance {:.3g}", describe_rung(candidate.nodes_per_section),
                                         tried.time.tolerance));
  };
  auto best = pilot_at(finest);
  if (!best) return choice;
  constexpr double share_of_time = 0.25;  // of the tolerance, that steps may use up
  const double most = std::min(room, share_of_time * pilots.request().tolerance);
  for (const double factor : {30.0, 10.0, 3.0, 1.0}) {
    auto pilot = pilot_at(factor * scene.time.tolerance);
    if (!pilot || !pilot->failure.empty()) continue;
    const double error = pilots.compare(*pilot, *best);
    const bool is_allowed = factor == 1.0 ? error <= room : error <= most;
    if (is_allowed) return {factor * scene.time.tolerance, error, std::move(pilot)};
  }
  if (std::isfinite(room)) choice.pilot = std::move(best);
  return choice;
}

bool note_pilot(const SceneConfig& scene, const PlanPilots& pilots, Plan& plan, Candidate& candidate,
                const Pilot& pilot) {
  candidate.seconds = pilot.seconds * scene.time.end / pilot.end();
  candidate.contact = record_contact(pilot.analysis);
  const ContactRecord& contact = candidate.contact;
  if (!pilot.failure.empty())
    candidate.verdict = "breaks off: " + pilot.failure;
  else if (contact.has_crossed() || (pilots.asks_contact() && contact.depth > pilots.request().tolerance))
    candidate.verdict = describe_contact(contact);
  if (candidate.verdict.empty()) {
    plan.pilot_end = std::min(plan.pilot_end, pilot.end());
    return true;
  }
  candidate.error = std::numeric_limits<double>::infinity();
  return false;
}

std::string try_variants(PlanPilots& pilots, const SceneConfig& scene, const Pilot& best, Candidate& chosen) {
  std::string faster;
  const auto try_out = [&](SceneConfig tried, const std::string& words) {
    constexpr double least_gain = 0.9;
    const auto pilot = pilots.run(tried, words, least_gain * chosen.seconds);
    if (!pilot || !pilot->is_whole()) return;
    const double error = pilots.compare(*pilot, best);
    if (!(chosen.error + error <= pilots.request().tolerance)) return;
    chosen.error += error;
    chosen.seconds = pilot->seconds;
    chosen.scene = std::move(tried);
    faster += (faster.empty() ? "" : ", ") + words;
  };
  const auto& sums = scene.hydrodynamics;
  if (sums.method == SumMethod::automatic && sums.precision == Precision::automatic) {
    SceneConfig tried = chosen.scene;
    tried.hydrodynamics.method = SumMethod::direct;
    tried.hydrodynamics.precision = Precision::in_single;
    try_out(std::move(tried), "direct sums with pairs in single precision");
  }
  if (scene.time.method == TimeMethod::rkc2 && chosen.nodes_per_section != rigid_rung) {
    SceneConfig tried = chosen.scene;
    tried.time.method = TimeMethod::trbdf2;
    try_out(std::move(tried), "the implicit method TR-BDF2");
  }
  return faster;
}

}  // namespace skein
