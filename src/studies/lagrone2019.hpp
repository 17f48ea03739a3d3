#pragma once

#include "runs/run_analysis.hpp"
#include "studies/acceptance.hpp"
#include "studies/paper_timings.hpp"

#include <map>
#include <string>
#include <vector>

namespace skein {

// What LaGrone, Cortez, Yan, Fauci 2019, "Complex dynamics of long, flexible fibers in shear", report, and how it is
// measured: all of the paper's numbers stand in lagrone2019.cpp, and nowhere else.

/// One of the paper's five fibers.
struct PaperFiber {
  const char* name;  ///< of its run's folder
  int sections;
  double end;                    ///< time to which its figures go
  double elasto_viscous_number;  ///< as printed
  const char* figures;           ///< that need its run, between blanks
};
const std::vector<PaperFiber>& list_paper_fibers();

/// "table1", "figure2", ..., and what each shows.
const std::vector<std::pair<std::string, std::string>>& list_paper_figures();

/// Analyses by the runs' names; rows of runs that are not there, or not yet far enough, are not reached.
using PaperRuns = std::map<std::string, RunAnalysis>;

/// @param figure   one of list_paper_figures()
/// @param timings  of figure 8; empty: not reached
std::vector<AcceptanceRow> compare_with_paper(const std::string& figure, const PaperRuns& runs,
                                              const std::vector<SumTiming>& timings);

}  // namespace skein
