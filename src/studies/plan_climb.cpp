#include "studies/plan_climb.hpp"

#include "studies/ladder_table.hpp"
#include "studies/plan_amplification.hpp"
#include "studies/plan_candidates.hpp"
#include "studies/rung_name.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace skein {
namespace {

class LadderClimb {
 public:
  LadderClimb(const SceneConfig& scene, PlanPilots& pilots, Plan& plan) : scene_(scene), pilots_(pilots), plan_(plan) {}

  std::optional<Pilot> run(const std::size_t coarsest, std::optional<Pilot> known) {
    climb(coarsest, std::move(known));
    return std::move(chosen_);
  }

 private:
  /// A candidate's pilot that is neither broken off nor senseless.
  struct Climbed {
    std::size_t index;
    Pilot pilot;
  };

  void climb(const std::size_t coarsest, std::optional<Pilot> known) {
    std::optional<Climbed> below;
    int failed = rigid_rung;  // the rung below that one, which is not good enough
    for (std::size_t i = 0; i < plan_.candidates.size(); ++i) {
      if (plan_.candidates[i].is_barred) continue;
      auto pilot = i == coarsest && known ? std::move(known) : run_candidate(i);
      if (!pilot) return;
      if (!note(plan_.candidates[i], *pilot)) {
        below.reset();
        continue;
      }
      if (!amplification_ && plan_.candidates[i].nodes_per_section > chain_rung)
        amplification_ = measure_amplification(pilots_, plan_.candidates[i], *pilot);
      if (below && judge(*below, i, *pilot)) {
        // What it was set against may have come too late for the rungs below it.
        refine(failed, below->index, below->pilot);
        return plan_.chosen >= 0 ? void() : choose(std::move(*below));
      }
      if (below) {
        failed = plan_.candidates[below->index].nodes_per_section;
        refine(failed, i, *pilot);
        if (plan_.chosen >= 0) return;
      }
      below = Climbed{i, std::move(*pilot)};
    }
    // The finest tube has none above it: its error is taken for half of its difference from the one below.
    Candidate& finest = plan_.candidates.back();
    const Candidate& last = plan_.candidates[plan_.candidates.size() - 2];
    if (last.compared_with == finest.nodes_per_section)
      finest.error = 0.5 * find_largest_error(last.found) + plan_.time_error;
    else if (!std::isfinite(finest.error))
      finest.error = find_ladder_error(finest.nodes_per_section) + plan_.time_error;
    if (finest.error <= pilots_.request().tolerance && below && below->index + 1 == plan_.candidates.size())
      choose(std::move(*below));
  }

  void choose(Climbed climbed) {
    plan_.chosen = static_cast<int>(climbed.index);
    chosen_ = std::move(climbed.pilot);
  }

  std::optional<Pilot> run_candidate(const std::size_t i) {
    if (i == reference_index_ && reference_ && reference_->is_whole()) return reference_;
    return pilots_.run(plan_.candidates[i].scene, describe_rung(plan_.candidates[i].nodes_per_section));
  }

  /// How much longer the scene takes than pilots did: phases drift with time, and are taken to go on as they did.
  double rest() const { return plan_.end / plan_.pilot_end; }

  /// The error of a rung whose answers differ so from a better one's.
  double predict(const int rung, const int better, const double difference) const {
    const double table = find_ladder_error(better);
    // How much fibers bend, which rigid ones do not, the better rung says to within its own error of bending ones.
    const double error = rung == rigid_rung
                             ? difference * (1.0 + table) + find_rigid_error()
                             : std::max(difference + table, extrapolate_difference(rung, better, difference));
    return error * rest() + plan_.time_error;
  }

  /// @param better  the pilot of the candidate `above`
  /// @returns true if the lower rung is good enough
  bool judge(const Climbed& lower, const std::size_t above, const Pilot& better) {
    Candidate& candidate = plan_.candidates[lower.index];
    candidate.found = pilots_.list_differences(lower.pilot, better);
    candidate.compared_with = plan_.candidates[above].nodes_per_section;
    const double difference = find_largest_error(candidate.found);
    candidate.error = predict(candidate.nodes_per_section, candidate.compared_with, difference);
    if (!std::isfinite(plan_.candidates[above].error))
      plan_.candidates[above].error = find_ladder_error(candidate.compared_with) * rest() + plan_.time_error;
    if (is_beyond_doubt(candidate, difference)) return true;
    const bool is_compared = compare_with_reference(candidate, lower.pilot, above + 1, difference);
    if (is_compared && candidate.error <= pilots_.request().tolerance) return true;
    Question worst = Question::shape;
    find_largest_error(candidate.found, &worst);
    candidate.verdict = candidate.error <= pilots_.request().tolerance ? "no finer rung had the time to show it"
                                                                       : fmt::format("{} fails", name_of(worst));
    return false;
  }

  /// True where a difference from a neighbour is enough: what both have in common is more than in the table in some
  /// scenes, 2.7 times as much in a U-turn, and more still where little things grow.
  bool is_beyond_doubt(const Candidate& candidate, const double difference) const {
    if (!(candidate.error <= pilots_.request().tolerance)) return false;
    constexpr double most_of_table = 3.0;
    const double common =
        std::max(most_of_table, amplification_.value_or(0.0)) * find_ladder_error(candidate.compared_with);
    return candidate.nodes_per_section == rigid_rung ||
           (difference + common) * rest() + plan_.time_error <= pilots_.request().tolerance;
  }

  /// True where a tube has little in common with this one: twice its nodes, or all that there are.
  bool is_far_above(const int rung, const int nodes_per_section) const {
    return rung >= 2 * nodes_per_section || rung == plan_.candidates.back().nodes_per_section;
  }

  /// Measures a rung against the lowest one far above it whose own error, by the table, leaves room for the difference
  /// that was found, or else against the finest, which runs for a share of the time that pilots may take.
  /// @param difference  of the candidate from its neighbour
  /// @returns false where none could be run
  bool compare_with_reference(Candidate& candidate, const Pilot& run, const std::size_t above,
                              const double difference) {
    const auto& all = plan_.candidates;
    const double growth = std::max(1.0, 0.5 * amplification_.value_or(0.0));
    const auto will_do = [&](const Candidate& rung) {
      const double common = growth * find_ladder_error(rung.nodes_per_section);
      return !rung.is_barred && is_far_above(rung.nodes_per_section, candidate.nodes_per_section) &&
             (difference + common) * rest() + plan_.time_error <= pilots_.request().tolerance;
    };
    const auto rung = std::find_if(all.begin() + static_cast<std::ptrdiff_t>(above), all.end(), will_do);
    if (rung == all.end() || !use_reference(static_cast<std::size_t>(rung - all.begin()))) return false;
    measure(candidate, run);
    return true;
  }

  /// @returns false where this one takes too long, or breaks off
  bool use_reference(const std::size_t index) {
    if (reference_ && index <= reference_index_) return true;
    if (index >= too_dear_) return false;
    constexpr double share_of_pilots = 0.25;
    const double seconds = share_of_pilots * pilots_.request().max_seconds;
    const Candidate& rung = plan_.candidates[index];
    auto pilot = pilots_.run(
        rung.scene, fmt::format("{}, for {:.3g} s at most", describe_rung(rung.nodes_per_section), seconds), seconds);
    // Differences grow faster than time where fibers flip or meet: less than half of it says too little of the rest.
    constexpr double least_share = 0.5;
    if (!pilot || !pilot->failure.empty() || pilot->end() < least_share * scene_.time.end) {
      too_dear_ = index;
      return false;
    }
    reference_ = std::move(pilot);
    reference_index_ = index;
    return true;
  }

  void measure(Candidate& candidate, const Pilot& run) {
    const int rung = plan_.candidates[reference_index_].nodes_per_section;
    plan_.pilot_end = std::min(plan_.pilot_end, reference_->end());
    candidate.found = pilots_.list_differences(run, *reference_);
    candidate.compared_with = rung;
    candidate.error = predict(candidate.nodes_per_section, rung, find_largest_error(candidate.found));
  }

  /// Where one rung is not good enough, its neighbour above seems so, and numbers of nodes lie between: the first of
  /// those that is. Each costs about two thirds of the next.
  /// @param better  the pilot of the candidate `above`
  void refine(const int lower, const std::size_t above, const Pilot& better) {
    const int first = lower + 1;
    const int last = plan_.candidates[above].nodes_per_section - 1;
    if (first <= chain_rung + 1 || first > last || !reference_) return;
    if (pilots_.compare(better, *reference_) > pilots_.request().tolerance) return;
    for (int rung = first; rung <= last; ++rung) {
      if (!is_far_above(plan_.candidates[reference_index_].nodes_per_section, rung)) return;
      Candidate between = make_candidate(scene_, rung);
      if (between.is_barred) continue;
      between.scene.time.tolerance = plan_.time_tolerance;
      auto pilot = pilots_.run(between.scene, describe_rung(rung));
      if (!pilot || !note(between, *pilot)) continue;
      measure(between, *pilot);
      if (!(between.error <= pilots_.request().tolerance)) continue;
      plan_.candidates.insert(plan_.candidates.begin() + static_cast<std::ptrdiff_t>(above), std::move(between));
      return choose({above, std::move(*pilot)});
    }
  }

  bool note(Candidate& candidate, const Pilot& pilot) const {
    return note_pilot(scene_, pilots_, plan_, candidate, pilot);
  }

  const SceneConfig& scene_;
  PlanPilots& pilots_;
  Plan& plan_;
  std::optional<double> amplification_;  ///< none before a tube's pilot has run
  std::optional<Pilot> chosen_;          ///< of the chosen candidate
  std::optional<Pilot> reference_;       ///< what others were measured against, as far as it got
  std::size_t reference_index_ = 0;      ///< of the candidates
  std::size_t too_dear_ = std::numeric_limits<std::size_t>::max();  ///< the lowest candidate that no reference could be
};

}  // namespace

std::optional<Pilot> climb_ladder(const SceneConfig& scene, PlanPilots& pilots, Plan& plan, const std::size_t coarsest,
                                  std::optional<Pilot> known) {
  return LadderClimb(scene, pilots, plan).run(coarsest, std::move(known));
}

}  // namespace skein
