#include "studies/plan.hpp"

#include <skein/core/error.hpp>
#include <skein/core/stopwatch.hpp>
#include <skein/fibers/fiber.hpp>
#include <skein/physics/scene_times.hpp>

#include "studies/ladder_table.hpp"
#include "studies/rung.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

namespace skein {
namespace {

constexpr int n_intervals = 400;        ///< of a pilot's frames: snaking is measured in a few units of time
constexpr double share_of_time = 0.25;  ///< of the tolerance, that steps may use up
// The upper rung's own error, over its difference from the lower one: coarse rungs have errors in common.
constexpr double least_rest = 0.5, largest_rest = 1.5;

/// Pilots of one scene in the time that is left for them.
class Planner {
 public:
  Planner(const SceneConfig& scene, const PlanRequest& request, const std::function<void(const std::string&)>& say)
      : scene_(resolve_times(scene)), request_(request), say_(say), start_(WallClock::now()) {
    plan_.end = plan_.pilot_end = scene_.time.end;
  }

  Plan make() {
    list_candidates();
    choose_steps();
    climb();
    try_variants();
    judge();
    plan_.seconds = seconds_since(start_);
    return std::move(plan_);
  }

 private:
  double seconds_left() const { return request_.max_seconds - seconds_since(start_); }

  void list_candidates() {
    int finest = 0;
    for (const FiberConfig& fiber : scene_.fibers) finest = std::max({finest, find_rung(fiber), chain_rung});
    const bool has_torque = !scene_.torques.empty();
    std::vector<int> rungs{rigid_rung};
    if (finest > chain_rung && !has_torque) rungs.push_back(chain_rung);  // a chain knows no twist
    for (const LadderRow& row : list_ladder())
      if (row.nodes_per_section > chain_rung) rungs.push_back(row.nodes_per_section);
    rungs.push_back(finest);
    std::sort(rungs.begin(), rungs.end());
    rungs.erase(std::unique(rungs.begin(), rungs.end()), rungs.end());
    for (const int rung : rungs) {
      Candidate candidate;
      candidate.nodes_per_section = rung;
      try {
        candidate.scene = make_rung_scene(scene_, rung);
      } catch (const Error&) {
        continue;  // no blob serves
      }
      candidate.n_nodes = count_nodes(make_fibers(candidate.scene.fibers));
      candidate.error = std::numeric_limits<double>::quiet_NaN();
      if (const std::string bar = find_bar_to_rigid(scene_); rung == rigid_rung && !bar.empty()) {
        candidate.error = std::numeric_limits<double>::infinity();
        candidate.verdict = bar;
      }
      plan_.candidates.push_back(std::move(candidate));
    }
    // Rigid fibers have steps of their own, whose errors say nothing of those that bend.
    const auto bends = std::find_if(plan_.candidates.begin(), plan_.candidates.end(),
                                    [](const Candidate& c) { return c.nodes_per_section > rigid_rung; });
    if (bends == plan_.candidates.end()) throw Error(ExitCode::scene_error, "no tube stands for the scene's fibers");
    coarsest_index_ = static_cast<std::size_t>(bends - plan_.candidates.begin());
  }

  /// @returns none where there is no time for it, or it did not get past a tenth of the scene's time
  std::optional<Pilot> run(const SceneConfig& scene, const std::string& words) {
    if (seconds_left() <= 0.0) return std::nullopt;
    say_(words);
    Pilot pilot = run_pilot(scene, n_intervals, seconds_left());
    constexpr double least_share = 0.1;
    if (pilot.end() < least_share * scene_.time.end) return std::nullopt;
    plan_.pilot_end = std::min(plan_.pilot_end, pilot.end());
    return pilot;
  }

  /// The longest steps whose error is a quarter of the tolerance, by the coarsest rung that bends.
  void choose_steps() {
    plan_.time_tolerance = scene_.time.tolerance;
    if (scene_.time.step > 0.0) return;  // the scene says how long they are
    const Candidate& coarsest = plan_.candidates[coarsest_index_];
    SceneConfig scene = coarsest.scene;
    const auto pilot_at = [&](const double factor) {
      scene.time.tolerance = factor * scene_.time.tolerance;
      return run(scene, fmt::format("pilot: {}, time.tolerance {:.3g}", name_rung(coarsest.nodes_per_section),
                                    scene.time.tolerance));
    };
    const auto best = pilot_at(0.3);
    if (!best) return;
    for (const double factor : {30.0, 10.0, 3.0, 1.0}) {
      auto pilot = pilot_at(factor);
      if (!pilot || !pilot->failure.empty()) continue;
      const double error = find_largest_error(compare_answers(*pilot, *best, request_.asked));
      if (error > share_of_time * request_.tolerance && factor > 1.0) continue;
      plan_.time_tolerance = factor * scene_.time.tolerance;
      plan_.time_error = error;
      coarsest_ = std::move(pilot);
      return;
    }
  }

  /// From the coarsest tube to the first that is good enough; each difference judges the lower of two rungs.
  void climb() {
    std::optional<Pilot> below;
    const auto choose = [&](const std::size_t i) {
      plan_.chosen = static_cast<int>(i);
      chosen_ = std::move(below);
    };
    for (std::size_t i = 0; i < plan_.candidates.size(); ++i) {
      Candidate& candidate = plan_.candidates[i];
      candidate.scene.time.tolerance = plan_.time_tolerance;
      if (!candidate.verdict.empty()) continue;
      const std::string words = "pilot: " + name_rung(candidate.nodes_per_section);
      auto pilot = i == coarsest_index_ && coarsest_ ? std::move(coarsest_) : run(candidate.scene, words);
      if (!pilot) return;
      note(candidate, *pilot);
      if (!pilot->failure.empty()) {
        candidate.error = std::numeric_limits<double>::infinity();
        candidate.verdict = "breaks off: " + pilot->failure;
        below.reset();
        continue;
      }
      if (below && judge_below(i - 1, *below, *pilot)) return choose(i - 1);
      below = std::move(pilot);
    }
    // The finest tube is judged by the table alone.
    Candidate& finest = plan_.candidates.back();
    if (std::isnan(finest.error)) finest.error = find_ladder_error(finest.nodes_per_section) + plan_.time_error;
    if (finest.error <= request_.tolerance && below) choose(plan_.candidates.size() - 1);
  }

  void note(Candidate& candidate, const Pilot& pilot) {
    candidate.seconds = pilot.seconds * scene_.time.end / pilot.end();
    const auto& gaps = pilot.analysis.smallest_gap;
    const double gap = *std::min_element(gaps.begin(), gaps.end());
    const int inside = *std::max_element(pilot.analysis.nodes_inside.begin(), pilot.analysis.nodes_inside.end());
    if (inside > 0)
      plan_.contact = fmt::format(
          "with {} nodes on a section surfaces are pressed into each other, up to {} nodes inside (smallest gap "
          "{:.3g})",
          candidate.nodes_per_section, inside, gap);
  }

  /// Of the chosen tube: pairs in single precision and an implicit method, where the scene leaves the choice open. One
  /// that is no faster is given up in the time that the chosen one took.
  void try_variants() {
    if (!chosen_ || !chosen_->is_whole()) return;
    Candidate& chosen = plan_.candidates[plan_.chosen];
    const auto try_out = [&](SceneConfig scene, const std::string& words) {
      if (seconds_left() <= 0.0) return;
      say_("pilot: " + words);
      constexpr double least_gain = 0.9;
      const Pilot pilot = run_pilot(scene, n_intervals, std::min(seconds_left(), least_gain * chosen.seconds));
      if (!pilot.is_whole()) return;
      const double error = find_largest_error(compare_answers(pilot, *chosen_, request_.asked));
      if (!(chosen.error + error <= request_.tolerance)) return;
      chosen.error += error;
      chosen.seconds = pilot.seconds;
      chosen.scene = std::move(scene);
      plan_.variants += (plan_.variants.empty() ? "" : ", ") + words;
    };
    if (scene_.hydrodynamics.method == SumMethod::automatic && scene_.hydrodynamics.precision == Precision::automatic) {
      SceneConfig scene = chosen.scene;
      scene.hydrodynamics.method = SumMethod::direct;
      scene.hydrodynamics.precision = Precision::in_single;
      try_out(std::move(scene), "direct sums with pairs in single precision");
    }
    if (scene_.time.method == TimeMethod::rkc2 && chosen.nodes_per_section > rigid_rung) {
      SceneConfig scene = chosen.scene;
      scene.time.method = TimeMethod::trbdf2;
      try_out(std::move(scene), "the implicit method TR-BDF2");
    }
  }

  /// @returns true if the lower rung is good enough
  bool judge_below(const std::size_t lower, const Pilot& run, const Pilot& better) {
    Candidate &candidate = plan_.candidates[lower], &above = plan_.candidates[lower + 1];
    candidate.found = compare_answers(run, better, request_.asked);
    const double difference = find_largest_error(candidate.found);
    // Phases drift with time: what pilots did not reach is taken to go on as it did.
    const double rest = plan_.end / plan_.pilot_end;
    const double table = find_ladder_error(above.nodes_per_section);
    const double error_above =
        std::max(least_rest * table, std::clamp(table, least_rest * difference, largest_rest * difference));
    candidate.error = (difference + error_above) * rest + plan_.time_error;
    above.error = error_above * rest + plan_.time_error;
    if (!(candidate.error <= request_.tolerance)) {
      Question worst = Question::shape;
      find_largest_error(candidate.found, &worst);
      candidate.verdict = fmt::format("{} fails", name_of(worst));
      return false;
    }
    return true;
  }

  void judge() {
    // What no pilot measured: the pairs of a direct sum, and the stages that the springs ask for.
    const auto known = std::find_if(plan_.candidates.rbegin(), plan_.candidates.rend(),
                                    [](const Candidate& c) { return c.seconds > 0.0; });
    for (Candidate& candidate : plan_.candidates) {
      if (candidate.seconds > 0.0 || std::isinf(candidate.error) || known == plan_.candidates.rend()) continue;
      candidate.seconds = known->seconds * std::pow(1.0 * candidate.n_nodes / known->n_nodes, 2);
    }
    for (std::size_t i = 0; i < plan_.candidates.size(); ++i) {
      Candidate& candidate = plan_.candidates[i];
      if (static_cast<int>(i) == plan_.chosen) candidate.verdict = "chosen";
      if (candidate.verdict.empty())
        candidate.verdict = plan_.chosen >= 0 && static_cast<int>(i) > plan_.chosen ? "dearer" : "not looked at";
      if (std::isnan(candidate.error)) candidate.error = find_ladder_error(candidate.nodes_per_section);
      if (static_cast<int>(i) != plan_.chosen) candidate.scene.time.tolerance = plan_.time_tolerance;
    }
    explain();
  }

  void explain() {
    if (plan_.chosen >= 0) {
      const Candidate& chosen = plan_.candidates[plan_.chosen];
      plan_.reason = fmt::format("{}: the lowest rung whose answers stay within {:g} %",
                                 name_rung(chosen.nodes_per_section), 100.0 * request_.tolerance);
      if (!chosen.found.empty()) plan_.reason += ", by their difference from the next rung";
      return;
    }
    Question worst = Question::shape;
    double largest = 0.0;
    for (const Candidate& candidate : plan_.candidates)
      if (!candidate.found.empty()) largest = find_largest_error(candidate.found, &worst);
    plan_.reason =
        seconds_left() <= 0.0
            ? fmt::format("no rung was shown to be within {:g} % in {:g} s of pilot runs: give them more time",
                          100.0 * request_.tolerance, request_.max_seconds)
            : fmt::format("no rung is within {:g} %: {} still differs by {:.2g} % between the finest two",
                          100.0 * request_.tolerance, name_of(worst), 100.0 * largest);
  }

  SceneConfig scene_;
  const PlanRequest& request_;
  const std::function<void(const std::string&)>& say_;
  WallClock::time_point start_;
  std::size_t coarsest_index_ = 0;          ///< of the candidates: the lowest rung that bends
  std::optional<Pilot> coarsest_, chosen_;  ///< pilots that serve once more
  Plan plan_;
};

}  // namespace

Plan make_plan(const SceneConfig& scene, const PlanRequest& request,
               const std::function<void(const std::string&)>& say) {
  SKEIN_REQUIRE(request.tolerance > 0.0, "a tolerance is positive");
  return Planner(scene, request, say).make();
}

}  // namespace skein
