#pragma once

#include <string>
#include <vector>

namespace skein {

/// Errors of tubes of so many nodes, 1 being the chain, on a section against those of 24, the paper's fibers in shear;
/// which are the truth here; by `skein bench ladder`, whose table is perf/ladder.csv.
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
