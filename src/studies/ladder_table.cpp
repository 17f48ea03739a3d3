#include "studies/ladder_table.hpp"

#include "studies/rung_name.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

namespace skein {
namespace {

constexpr int no_rung = -1;

std::string name(const int rung) { return rung == no_rung ? "no rung" : describe_rung(rung); }

}  // namespace

const std::vector<LadderRow>& list_ladder() {
  // The largest over the lengths of perf/ladder.csv.
  static const std::vector<LadderRow> rows{{1, 0.10},  {4, 0.021},  {5, 0.018},   {6, 0.019},
                                           {9, 0.017}, {12, 0.016}, {18, 0.0091}, {24, 0.0}};
  return rows;
}

double find_ladder_error(const int nodes_per_section) {
  if (nodes_per_section < list_ladder().front().nodes_per_section) return std::numeric_limits<double>::quiet_NaN();
  double error = list_ladder().front().error;
  for (const LadderRow& row : list_ladder())
    if (row.nodes_per_section <= nodes_per_section) error = row.error;
  return error;
}

double find_rigid_error() {
  // By `skein bench ladder --lengths 0.139 --rungs 9,6,1,0 --stiffness 100`.
  return 0.001;
}

double extrapolate_difference(const int nodes_per_section, const int finer, const double difference) {
  if (nodes_per_section <= chain_rung || finer <= nodes_per_section) return difference;
  const auto excess_over = [&](const int rung) {
    return 1.0 / (1.0 * nodes_per_section * nodes_per_section) - 1.0 / (1.0 * rung * rung);
  };
  return difference * std::max(1.0, excess_over(finest_rung) / excess_over(finer));
}

int find_ladder_rung(const double tolerance) {
  for (const LadderRow& row : list_ladder())
    if (row.error <= tolerance) return row.nodes_per_section;
  return no_rung;
}

std::string describe_ladder() {
  return fmt::format(
      "resolution: for the paper's fibers in shear {} would do for 1 %, {} for 5 %, {} for 20 %; 'skein plan' measures "
      "what this scene needs",
      name(find_ladder_rung(0.01)), name(find_ladder_rung(0.05)), name(find_ladder_rung(0.2)));
}

}  // namespace skein
