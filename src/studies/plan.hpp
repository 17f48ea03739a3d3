#pragma once

#include <skein/scene/scene_config.hpp>

#include "studies/answers.hpp"
#include "studies/contact_record.hpp"

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
  int nodes_per_section = 0;  ///< or a rung below all tubes: see rung_name.hpp
  int n_nodes = 0;
  SceneConfig scene;               ///< what is run
  double error = 0.0;              ///< predicted; not a number where nothing is known
  double seconds = 0.0;            ///< predicted wall time
  std::string verdict;             ///< why it is taken, or is not
  std::vector<AnswerError> found;  ///< against another rung, where pilots ran
  int compared_with = 0;           ///< that rung
  bool is_barred = false;          ///< it cannot stand for the scene's fibers
  ContactRecord contact;           ///< of its pilot, where one ran

  bool bends() const { return !is_barred && nodes_per_section > 0; }
};

/// The cheapest way that is good enough.
struct Plan {
  std::vector<Candidate> candidates;  ///< from coarse to fine
  int chosen = -1;                    ///< of the candidates; -1: none is good enough
  double time_tolerance = 0.0;        ///< of the chosen one's steps
  double time_error = 0.0;            ///< that they cause
  double pilot_end = 0.0;             ///< to where pilots ran, of `end`
  double end = 0.0;
  double seconds = 0.0;       ///< that planning took
  bool is_by_table = false;   ///< the table of convergence has the scene: see ladder_reach.hpp
  std::string variants;       ///< sums and methods that proved faster than the scene's, in words; empty: none
  std::string reason;         ///< in one or two sentences
  std::string known_contact;  ///< what was known of it before, a line: see describe_known_contact
};

/// Finds it in the table of convergence where that has the scene (ladder_reach.hpp), and else by pilot runs of the
/// scene, from the coarsest rung on. Each is compared with the one above; one that may do is taken where the error of
/// the one above, by the table of convergence (ladder_table.hpp), fits in besides, or else set against a finer one,
/// which runs for a quarter of the pilots' time at most. Steps are as long as a quarter of the tolerance lets them be,
/// found on the lowest rung that bends. Where a rung does and the one below does not, other numbers of nodes between
/// them are tried. Needs Kokkos.
/// @param scene  its fibers are as written
/// @param say    called with a line before each pilot
Plan make_plan(const SceneConfig& scene, const PlanRequest& request,
               const std::function<void(const std::string&)>& say);

/// Why this one, or none; the plan is made but for that.
std::string explain_choice(const Plan& plan, const PlanRequest& request);

/// A table of all candidates and the reason for the choice.
std::string describe_plan(const Plan& plan, const PlanRequest& request);
std::string describe_plan_as_json(const Plan& plan, const PlanRequest& request);

}  // namespace skein
