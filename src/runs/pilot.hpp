#pragma once

#include <skein/scene/scene_config.hpp>

#include "runs/run_analysis.hpp"

#include <cstdint>
#include <string>
#include <vector>

namespace skein {

/// A run that leaves no files: what it did, and what that took.
struct Pilot {
  RunAnalysis analysis;  ///< of its frames, without forces
  /// Centroids of the sections of all fibers, frame by frame: [n_frames][n_sections], length
  std::vector<std::vector<Vec3>> centreline;
  std::int64_t evaluations = 0;
  double seconds = 0.0;  ///< wall time of steps and frames
  std::string failure;   ///< why it broke off; empty: it reached its end
  bool is_late = false;  ///< it was given up because it took too long

  double end() const { return analysis.time.back(); }
  bool is_whole() const { return failure.empty() && !is_late; }
};

/// Runs a scene in memory. Numerical failures end it, and are told. Needs Kokkos.
/// @param scene        its fibers are as written (see place_fibers)
/// @param n_intervals  frames after the first, evenly apart in time, > 0
/// @param max_seconds  of wall time, looked at after each step
/// @throws Error(scene_error) where the scene asks for what cannot be delivered
Pilot run_pilot(const SceneConfig& scene, int n_intervals, double max_seconds);

}  // namespace skein
