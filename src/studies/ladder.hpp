#pragma once

#include "studies/answers.hpp"

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace skein {

/// Which of the paper's fibers are run with how many nodes on a section.
struct LadderStudy {
  std::vector<double> lengths{0.139, 0.196, 0.523, 0.931};
  std::vector<int> rungs{24, 18, 12, 9, 6, 5, 4, 1};  ///< the first is what the others are compared with
  double stiffness = 1.0;                             ///< of springs, times the paper's
};

/// One run of the study.
struct LadderPoint {
  double length = 0.0;
  int nodes_per_section = 0, n_nodes = 0;
  double seconds = 0.0;  ///< wall time
  std::int64_t evaluations = 0;
  double half_period = 0.0, hook_radius = 0.0, snaking_speed = 0.0, curvature_max = 0.0;  ///< not a number: none
  std::vector<AnswerError> errors;  ///< against the first rung; none of its own
  double shape_errors[3] = {};      ///< at a third, two thirds and the end of the time
};

/// Runs them all, each length to the time of the paper's figures, or to where its ends first touch its sides. Steps
/// have a third of the default tolerance and sums 1e-5, so that the nodes alone make the difference. Needs Kokkos.
/// @param report  called with each point
std::vector<LadderPoint> measure_ladder(const LadderStudy& study,
                                        const std::function<void(const LadderPoint&)>& report);

/// A row for each point. Whole or not at all. @throws Error(io_error)
void write_ladder(const std::filesystem::path& path, const std::vector<LadderPoint>& points);

}  // namespace skein
