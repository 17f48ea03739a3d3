#include "studies/ladder_table.hpp"

#include "skein_ladder.hpp"
#include "studies/rung_name.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

namespace skein {
namespace {

constexpr int no_rung = -1;
constexpr std::size_t n_row_questions = 4;  ///< shape, half period, hook radius and snaking speed

std::string name(const int rung) { return rung == no_rung ? "no rung" : describe_rung(rung); }

}  // namespace

const std::vector<LadderRow>& list_ladder() {
  static const std::vector<LadderRow> rows = [] {
    std::map<int, double> largest;
    for (const LadderRun& run : measured_ladder) {
      double& error = largest[run.nodes_per_section];
      for (std::size_t question = 0; question < n_row_questions; ++question)
        error = std::max(error, std::isnan(run.errors[question]) ? 0.0 : run.errors[question]);
    }
    std::vector<LadderRow> found;
    for (const auto& [rung, error] : largest) found.push_back({rung, error});
    return found;
  }();
  return rows;
}

std::span<const LadderRun> list_ladder_runs() { return measured_ladder; }

double find_ladder_end(const double length) {
  if (length < 0.16) return 12.0;
  if (length < 0.3) return 15.0;
  return length < 0.7 ? 26.0 : 13.0;
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
