#pragma once

#include <skein/core/error.hpp>
#include <skein/scene/scene_config.hpp>

#include "studies/paper_scenes.hpp"
#include "studies/side_by_side.hpp"

#include <filesystem>
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
  SideBySide how;
};

/// One point of the diagram, to be run.
struct PhasePoint {
  std::string folder;  ///< in that of the study
  bool is_perturbed = false;
  SceneConfig scene;
};

/// A row for people, of four columns: length, elasto-viscous number, start, regime.
std::string describe_phase(const PhasePoint& point, const RunMeasures& measures);

/// @throws SceneError for a perturbation that a scene cannot have
std::vector<PhasePoint> list_phase_points(const PhaseStudy& study);

/// Brings the runs of all points to their ends, side by side, measures them, and writes phases.csv. Runs that are done
/// are not run again.
/// @returns done; stopped on request or by the wall time; or why the first point failed that did, without which the
///         table then is
ExitCode run_phase_study(const PhaseStudy& study, const std::vector<PhasePoint>& points, SideBySideListener& listener);

}  // namespace skein
