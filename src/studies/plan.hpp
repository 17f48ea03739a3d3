#pragma once

#include <skein/scene/scene_config.hpp>

#include "studies/answers.hpp"

#include <functional>
#include <string>
#include <vector>

namespace skein {

/// What is wanted of a scene's answer, and what finding out may take.
struct PlanRequest {
  double tolerance = 0.03;  ///< relative error of each answer that is asked for
  std::vector<Question> asked{Question::shape, Question::half_period, Question::hook_radius, Question::snaking_speed};
  double max_seconds = 600.0;  ///< wall time of all pilot runs
};

/// One way to run the scene.
struct Candidate {
  int nodes_per_section = 0;  ///< or a rung below all tubes, see rung.hpp
  int n_nodes = 0;
  SceneConfig scene;               ///< what is run
  double error = 0.0;              ///< predicted; not a number where nothing is known
  double seconds = 0.0;            ///< predicted wall time
  std::string verdict;             ///< why it is taken, or is not
  std::vector<AnswerError> found;  ///< against the next rung, where pilots ran
};

/// The cheapest way that is good enough.
struct Plan {
  std::vector<Candidate> candidates;  ///< from coarse to fine
  int chosen = -1;                    ///< of the candidates; -1: none is good enough
  double time_tolerance = 0.0;        ///< of the chosen one's steps
  double time_error = 0.0;            ///< that they cause
  double pilot_end = 0.0;             ///< to where pilots ran, of `end`
  double end = 0.0;
  double seconds = 0.0;  ///< that planning took
  std::string variants;  ///< sums and methods that proved faster than the scene's, in words; empty: none
  std::string reason;    ///< in one or two sentences
  std::string contact;   ///< what is known of surfaces that touch; empty: nothing touches
};

/// Finds it by pilot runs of the scene, from rigid fibers on: each is compared with the one above, whose own
/// error is that of the table of convergence (ladder_table.hpp), between half of the difference and one and a half of
/// it. Steps are as long as a quarter of the tolerance lets them be, found on the lowest rung that bends. Needs Kokkos.
/// @param scene  its fibers are as written
/// @param say    called with a line before each pilot
Plan make_plan(const SceneConfig& scene, const PlanRequest& request,
               const std::function<void(const std::string&)>& say);

/// A table of all candidates and the reason for the choice.
std::string describe_plan(const Plan& plan, const PlanRequest& request);
std::string describe_plan_as_json(const Plan& plan, const PlanRequest& request);

}  // namespace skein
