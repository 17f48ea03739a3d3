#include "studies/ladder_table.hpp"

#include <fmt/format.h>

namespace skein {

const std::vector<LadderRow>& list_ladder() {
  // The largest over L = 0.139, 0.196 and 0.523 of perf/ladder.csv.
  static const std::vector<LadderRow> rows{{1, 0.08, 0.004}, {4, 0.012, 0.018}, {5, 0.008, 0.025}, {6, 0.004, 0.04},
                                           {9, 0.003, 0.13}, {12, 0.002, 0.3},  {18, 0.001, 1.0}};
  return rows;
}

double find_ladder_error(const int nodes_per_section) {
  double error = list_ladder().front().error;
  for (const LadderRow& row : list_ladder())
    if (row.nodes_per_section <= nodes_per_section) error = row.error;
  return error;
}

int find_ladder_rung(const double tolerance) {
  for (const LadderRow& row : list_ladder())
    if (row.error <= tolerance) return row.nodes_per_section;
  return 0;
}

std::string describe_ladder() {
  return fmt::format(
      "resolution: for the paper's fibers in shear {} nodes on a section would do for 1 %, {} for 5 %, {} for 20 %; "
      "'skein plan' measures what this scene needs",
      find_ladder_rung(0.01), find_ladder_rung(0.05), find_ladder_rung(0.2));
}

}  // namespace skein
