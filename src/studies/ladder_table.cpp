#include "studies/ladder_table.hpp"

namespace skein {

const std::vector<LadderRow>& list_ladder() {
  // The largest over L = 0.139, 0.196 and 0.523 of perf/ladder.csv.
  static const std::vector<LadderRow> rows{{4, 0.012, 0.018}, {5, 0.008, 0.025}, {6, 0.004, 0.04},
                                           {9, 0.003, 0.13},  {12, 0.002, 0.3},  {18, 0.001, 1.0}};
  return rows;
}

double find_ladder_error(const int nodes_per_section) {
  double error = list_ladder().front().error;
  for (const LadderRow& row : list_ladder())
    if (row.nodes_per_section <= nodes_per_section) error = row.error;
  return error;
}

}  // namespace skein
