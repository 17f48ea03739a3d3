#pragma once

#include <skein/analysis/fiber_history.hpp>
#include <skein/analysis/force_moments.hpp>
#include <skein/io/run_folder.hpp>
#include <skein/scene/scene_config.hpp>

#include <filesystem>
#include <numbers>
#include <string>
#include <vector>

namespace skein {

/// Of a radian
inline constexpr double degrees = 180.0 / std::numbers::pi;

/// What the forces of one fiber do at one moment.
struct ForceRecord {
  Vec3 middle;          ///< the mean of the fiber's nodes, length
  Vec3 force, torque;   ///< of the fiber on the fluid: their sum, and their torque about the middle, force (* length)
  double energy = 0.0;  ///< of all forces that have one, force * length
  PowerBalance power;
  Matrix3 stresslet{};                  ///< force * length
  double viscosity_contribution = 0.0;  ///< length^3; see compute_viscosity_contribution
};

/// A run seen as a whole.
struct RunAnalysis {
  SceneConfig scene;
  std::string status;
  std::vector<Fiber> fibers;
  bool shares_energy = false;        ///< forces between fibers pass it from one to the other
  std::vector<double> time;          ///< [n_frames]
  std::vector<double> smallest_gap;  ///< [n_frames], length
  std::vector<int> nodes_inside;     ///< [n_frames], of another surface
  std::vector<double> depth;         ///< [n_frames], of the deepest of them, length
  std::vector<int> crossings;        ///< [n_frames], of centrelines since the first frame, as seen from frame to frame
  std::vector<FiberHistory> histories;           ///< [n_fibers]
  std::vector<std::vector<ForceRecord>> forces;  ///< [n_fibers][n_frames]; empty if they were not asked for
};

/// Reads all frames of a run. Needs Kokkos.
/// @param with_forces  also springs and fluid: one evaluation of the mobility for each frame
/// @throws Error(missing_input), Error(damaged_data); a run without frames is missing input
RunAnalysis analyze_run(const RunFolder& folder, bool with_forces);

/// Largest |E(t) - E(0) - integral of the elastic power|, by the trapezoidal rule over frames, over what the fluid
/// dissipated: how well the powers of springs, flow and fluid add up. Of all fibers together where forces between
/// them pass energy from one to the other. NaN without forces, and where the fluid takes no more
/// than a fiber's rounding does.
double measure_energy_defect(const RunAnalysis& analysis, int fiber);

/// diagnostics.csv, a row for each frame and fiber, and diagnostics.h5, the same by fibers with curvature along the
/// fibers and the tracks of its extrema. Makes the folder. @throws Error(io_error), Error(cannot_create)
void write_analysis(const RunAnalysis& analysis, const std::filesystem::path& folder);

/// The summary for people, and as one JSON object.
std::string describe_analysis(const RunAnalysis& analysis);
std::string describe_analysis_as_json(const RunAnalysis& analysis);

}  // namespace skein
