#pragma once

#include <skein/core/stopwatch.hpp>

#include "studies/plan.hpp"

#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <vector>

namespace skein {

/// Pilot runs of one scene's candidates, in the time that there is for all of them.
class PlanPilots {
 public:
  /// @param end      time to which the scene goes
  /// @param request, say  must outlive the object
  PlanPilots(double end, const PlanRequest& request, const std::function<void(const std::string&)>& say);

  /// @param max_seconds  of wall time, besides what is left for all
  /// @returns none where there is no time for it, or it did not get past a tenth of the scene's time, or, where contact
  /// is asked for, not to its end
  std::optional<Pilot> run(const SceneConfig& scene, const std::string& words,
                           double max_seconds = std::numeric_limits<double>::infinity());

  double seconds_left() const { return request_.max_seconds - seconds_since(start_); }
  double seconds() const { return seconds_since(start_); }

  std::vector<AnswerError> list_differences(const Pilot& run, const Pilot& better) const {
    return compare_answers(run, better, request_.asked);
  }
  double compare(const Pilot& run, const Pilot& better) const {
    return find_largest_error(list_differences(run, better));
  }
  /// Then a rung is also judged by how deep surfaces are in its own pilot, all of it.
  bool asks_contact() const;

  const PlanRequest& request() const { return request_; }

 private:
  double end_;
  const PlanRequest& request_;
  const std::function<void(const std::string&)>& say_;
  WallClock::time_point start_ = WallClock::now();
};

/// The longest steps whose error is a quarter of the tolerance, by one candidate.
struct StepChoice {
  double time_tolerance = 0.0;
  double error = 0.0;          ///< that they cause
  std::optional<Pilot> pilot;  ///< of the candidate with them; none where nothing was tried
};

/// @param finest  time tolerance of the steps that others are compared with
/// @param room    for their error; where not even the scene's own steps stay below, the finest are taken. Infinite: the
///                scene's own are good enough
StepChoice choose_steps(PlanPilots& pilots, const Candidate& candidate, const SceneConfig& scene, double finest,
                        double room);

/// Writes down what a candidate's pilot took, and contact.
/// @returns false where the pilot is no answer: it broke off, fibers crossed, after which it answers another question,
/// or surfaces met that are asked to stay apart
bool note_pilot(const SceneConfig& scene, const PlanPilots& pilots, Plan& plan, Candidate& candidate,
                const Pilot& pilot);

/// Of the chosen candidate: pairs in single precision and an implicit method, where the scene leaves the choice open.
/// One that is no faster is given up in the time that the chosen one took.
/// @param pilot  the chosen one's, whole
/// @returns what proved faster, in words; empty: nothing
std::string try_variants(PlanPilots& pilots, const SceneConfig& scene, const Pilot& pilot, Candidate& chosen);

}  // namespace skein
