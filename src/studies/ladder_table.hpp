#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace skein {

/// One of the runs of `skein bench ladder`, as perf/ladder.csv has it: a fiber of the paper's in shear, as a tube of so
/// many nodes on a section or, 1, a chain. What is not a number had no answer.
struct LadderRun {
  double length;  ///< nominal, in the paper's units
  int nodes_per_section, nodes;
  double seconds;  ///< wall time, on the machine that the table was made on
  std::int64_t evaluations;
  double half_period, hook_radius, snaking_speed, curvature_max;
  double errors[6];  ///< in the order of list_questions, against 24 nodes, which are the truth here and have none
  double shape_errors[3];
};
std::span<const LadderRun> list_ladder_runs();

/// To which time the table's fibers were followed, in the paper's units: one half turn, an S-turn, snaking, and the
/// longest ones until their ends are pressed into their sides.
double find_ladder_end(double length);

/// Tolerance of the table's steps, and of its sums: the nodes alone make the difference. 1 / time, in the paper's units
constexpr double ladder_time_tolerance = 3e-5;
constexpr double ladder_sum_tolerance = 1e-5;

/// The largest errors of a rung over the table's lengths.
struct LadderRow {
  int nodes_per_section;
  double error;  ///< the largest of shape (over the length), half period, hook radius and snaking speed
};
const std::vector<LadderRow>& list_ladder();

/// The error of a rung by that table; between its rows the coarser one's, beyond them the last one's. Not a number of
/// rigid fibers, below them: all depends on what bends the fibers of a scene.
double find_ladder_error(int nodes_per_section);

/// The same of rigid fibers in the stead of tubes that nothing bends: what is left where a rung that bends says so,
/// too.
double find_rigid_error();

/// The error of a tube, against the finest of the table, by its difference from one between them, if errors fall with
/// the square of the number of nodes: what differences say where a scene makes more of them than the table's fibers do.
/// The difference itself where one of them is no tube.
double extrapolate_difference(int nodes_per_section, int finer, double difference);

/// The fewest nodes on a section that are within a tolerance by that table; -1 where none are.
int find_ladder_rung(double tolerance);

/// Which rungs would do for which tolerance, a line.
std::string describe_ladder();

}  // namespace skein
