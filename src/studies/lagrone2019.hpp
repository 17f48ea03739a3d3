#pragma once

#include "runs/run_analysis.hpp"
#include "studies/acceptance.hpp"
#include "studies/paper_scenes.hpp"
#include "studies/paper_timings.hpp"

#include <map>
#include <string>
#include <vector>

namespace skein {

// What LaGrone, Cortez, Yan, Fauci 2019, "Complex dynamics of long, flexible fibers in shear", report, and how it is
// measured: all of the paper's numbers stand in lagrone2019.cpp, and nowhere else.

enum class Figure { table1, figure2, figure3, figure4, figure5, figure6, figure7, figure8 };

/// One of the paper's five fibers.
struct PaperFiber {
  const char* name;  ///< of its run's folder
  int sections;
  double end;                          ///< time to which its figures go
  double elasto_viscous_number;        ///< as printed
  std::vector<Figure> figures;         ///< that need its run
  int rung = paper_nodes_per_section;  ///< of its run, unless others are asked for
  bool keeps_plane = false;            ///< as long as nothing but rounding brings it out
  double start_noise = 0.0;            ///< of its run, over the length: what is to bring it out
};
const std::vector<PaperFiber>& list_paper_fibers();

/// What is run for a fiber.
SceneConfig make_run_scene(const PaperFiber& fiber, int rung);

/// Analyses by the runs' names; rows of runs that are not there, or not yet far enough, are not reached.
using PaperRuns = std::map<std::string, RunAnalysis>;

/// One of the paper's figures or tables.
struct PaperFigure {
  Figure figure;
  const char* name;     ///< "figure2", as people write it
  const char* content;  ///< what it shows, and what it takes
  std::vector<AcceptanceRow> (*compare)(const PaperRuns& runs, const std::vector<SumTiming>& timings);
};
/// The quick ones first.
const std::vector<PaperFigure>& list_paper_figures();
const PaperFigure& find_paper_figure(Figure figure);

/// @param timings  of figure 8; empty: not reached
std::vector<AcceptanceRow> compare_with_paper(Figure figure, const PaperRuns& runs,
                                              const std::vector<SumTiming>& timings);

}  // namespace skein
