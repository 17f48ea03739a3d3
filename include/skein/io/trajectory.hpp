#pragma once

#include <skein/core/vec3.hpp>
#include <skein/fibers/fiber.hpp>

#include <cstdint>
#include <limits>
#include <map>
#include <string>
#include <variant>
#include <vector>

namespace skein {

/// All nodes at one moment, with what is derived from them; row-major, as files hold it.
struct Frame {
  std::int64_t step = 0;  ///< accepted steps before this moment
  double time = 0.0;
  std::vector<Vec3> position;     ///< [n_nodes], length
  std::vector<Vec3> centreline;   ///< [n_sections], section centroids, length
  std::vector<double> curvature;  ///< [n_sections], unsigned, 1 / length
};

/// Small numbers of one accepted step.
struct StepRecord {
  std::int64_t step = 0;
  double time = 0.0;
  double dt = 0.0;
  double error = 0.0;            ///< estimated local error over tolerance
  double estimated_error = 0.0;  ///< sum of the estimated local errors, root mean square over nodes, length
  double spectral_radius = 0.0;  ///< 1 / time
  std::int64_t evaluations = 0;  ///< of the right-hand side, since the start of the run
  double velocity_error = std::numeric_limits<double>::quiet_NaN();  ///< last one measured, relative; see ErrorRecord
  int fmm_order = 0;                                                 ///< of the last evaluation; 0: summed directly
  std::int64_t fmm_misses = 0;          ///< checks that found more than the tolerance, since the start of the run
  double smallest_gap = 0.0;            ///< between surfaces of distant sections, length
  std::int64_t nodes_inside = 0;        ///< of the surface of another fiber, or of a distant part of their own
  double depth = 0.0;                   ///< of the deepest of them: its distance to that surface, length
  std::int64_t crossings = 0;           ///< of centrelines, since the start of the run; see count_crossings
  std::vector<double> energy;           ///< [n_fibers], elastic
  std::vector<double> length;           ///< [n_fibers], of the centreline
  std::vector<double> curvature_max;    ///< [n_fibers], 1 / length
  std::vector<double> symmetry_defect;  ///< [n_fibers], departure from odd symmetry over length
  std::vector<double> out_of_plane;     ///< [n_fibers], largest distance from the fiber's own plane, length
  std::vector<Vec3> end_to_end;         ///< [n_fibers], last section centroid - first, length
};

/// A number, or a list such as one number per fiber, with its unit ("" where it has no dimension).
struct Quantity {
  std::variant<double, std::vector<double>> value;
  std::string unit;
};

/// What does not change during a run: the shape of all arrays, and what a reader needs to make sense of them.
struct TrajectoryLayout {
  std::vector<Fiber> fibers;
  std::vector<double> blobs;                      ///< [n_nodes], length
  std::map<std::string, std::string> attributes;  ///< of /parameters: "title", "scene", "version", "build", ...
  std::map<std::string, Quantity> parameters;     ///< datasets of /parameters: "bending_rigidity", ...
};

}  // namespace skein
