#pragma once

#include <skein/core/error.hpp>

#include "runs/run_listener.hpp"
#include "studies/lagrone2019.hpp"

#include <filesystem>
#include <limits>
#include <optional>
#include <vector>

namespace skein {

/// The figures whose runs take minutes.
const std::vector<Figure>& list_quick_figures();

/// Figures of LaGrone, Cortez, Yan, Fauci 2019, made again.
struct Reproduction {
  std::filesystem::path folder = "lagrone2019";  ///< of runs and tables
  std::vector<Figure> figures = list_quick_figures();
  std::optional<int> rung;                                        ///< of all runs; none: each fiber's own
  double max_walltime = std::numeric_limits<double>::infinity();  ///< seconds since the program began
  bool only_compare = false;                                      ///< what is there; nothing is run or timed
};

struct ReproductionResult {
  ExitCode code = ExitCode::done;  ///< or stopped on request or by the wall time; the rows tell what is there
  std::vector<AcceptanceRow> rows;
};

/// Brings the runs that the figures need to their ends, measures all that are there and compares: tables of each run,
/// timings.csv for figure 8, comparison.csv. Runs that are done are not run again. Needs Kokkos.
ReproductionResult reproduce_figures(const Reproduction& request, RunListener& listener);

}  // namespace skein
