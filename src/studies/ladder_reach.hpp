#pragma once

#include <skein/scene/scene_config.hpp>

#include "studies/answers.hpp"

#include <optional>
#include <vector>

namespace skein {

/// What the table of convergence says of one scene: errors and costs of its rungs, without a run.
struct LadderReach {
  double length = 0.0;          ///< of the table's fiber, in the paper's units
  double time_tolerance = 0.0;  ///< of the table's steps, in the scene's units, 1 / time
  std::vector<Question> asked;

  /// @returns the largest error of what is asked. Between the table's rungs on the straight line through them, where
  /// errors are below it; of the finest, which is the truth here, half of what the next one's is. Not a number below
  /// the chain.
  double find_error(int nodes_per_section) const;

  /// The same of each question; those that the fiber does not answer are left out.
  std::vector<AnswerError> list_errors(int nodes_per_section) const;

  /// Wall time of the run on the machine that the table was made on; between rungs as find_error does.
  double find_seconds(int nodes_per_section) const;
};

/// The table's fiber that a scene is, in whatever units and with whatever rung: the length within two per cent, blob
/// and stiffness within as much of what that rung would have, straight along the shear, to between four fifths of the
/// table's time and all of it, with sums and steps that are no looser than usual. None where it is none of them, or
/// contact is asked for, of which the table's fibers have none.
/// @param scene  its fibers are placed, its times resolved
std::optional<LadderReach> find_ladder_reach(const SceneConfig& scene, const std::vector<Question>& asked);

}  // namespace skein
