#pragma once

#include <skein/core/error.hpp>
#include <skein/scene/scene_config.hpp>

#include "runs/run_analysis.hpp"
#include "runs/run_listener.hpp"
#include "studies/paper_scenes.hpp"

#include <filesystem>
#include <functional>
#include <limits>
#include <string>
#include <vector>

namespace skein {

/// The phase diagram: which regimes fibers of LaGrone, Cortez, Yan, Fauci 2019 go through in shear, over their length.
struct PhaseStudy {
  std::filesystem::path folder = "phases";  ///< of the runs and of phases.csv
  double from = 0.08, to = 0.6;             ///< lengths of the shortest and of the longest fiber
  double end = 30.0;                        ///< time to which each is followed
  int count = 20;                           ///< lengths, evenly apart
  int rung = paper_nodes_per_section;       ///< another: see make_rung_scene
  std::vector<std::string> perturbation;    ///< "key=value" of the scene; with any, each fiber is also run with them
  double max_walltime = std::numeric_limits<double>::infinity();  ///< seconds since the program began
};

/// One point of the diagram, to be run.
struct PhasePoint {
  std::string folder;  ///< in that of the study
  bool is_perturbed = false;
  SceneConfig scene;
};

/// One point as it came out.
struct PhaseResult {
  double length = 0.0;
  double elasto_viscous_number = 0.0;  ///< with c = ln(4e/rho^2), at the paper's shear rate
  bool is_perturbed = false;
  FiberSummary summary;
};

/// @throws SceneError for a perturbation that a scene cannot have
std::vector<PhasePoint> list_phase_points(const PhaseStudy& study);

/// Brings the runs of all points to their ends and measures them; phases.csv is whole after each. Runs that are done
/// are not run again. Needs Kokkos.
/// @param report  called with each point once it is measured
/// @returns done, or stopped on request or by the wall time
ExitCode run_phase_study(const PhaseStudy& study, const std::vector<PhasePoint>& points, RunListener& listener,
                         const std::function<void(const PhaseResult&)>& report);

}  // namespace skein
