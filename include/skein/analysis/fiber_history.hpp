#pragma once

#include <skein/analysis/curvature_extrema.hpp>
#include <skein/analysis/flow_frame.hpp>
#include <skein/analysis/hook.hpp>
#include <skein/analysis/orientation.hpp>
#include <skein/analysis/plane_tracker.hpp>
#include <skein/analysis/regime.hpp>
#include <skein/fibers/fiber.hpp>

#include <optional>
#include <span>
#include <vector>

namespace skein {

/// Hooks while they are new, which is what fibers of different lengths can be compared by.
struct Snaking {
  double begin = 0.0, end = 0.0;  ///< times, of the window that was measured
  double hook_radius = 0.0;       ///< median over the window and both ends, length
  double speed = 0.0;             ///< of the peaks of curvature along the fiber, away from its ends, length / time
  double determination = 0.0;     ///< of the line fit, the worse of both ends
};

/// What one fiber did, in a few numbers.
struct FiberSummary {
  std::vector<Passage> passages;     ///< none in a flow that does not turn fibers
  std::vector<double> half_periods;  ///< likewise
  std::vector<RegimeChange> changes;
  Regime regime = Regime::tumble;  ///< the most complex one reached
  std::vector<ExtremumTrack> tracks;
  Wave wave = Wave::unclear;                    ///< of the tracks, weighted by their duration
  std::optional<Snaking> snaking;               ///< none where no end folded back
  double stretch_min = 0.0, stretch_max = 0.0;  ///< length over that at the first moment, less 1
  double curvature_max = 0.0;                   ///< 1 / length
  double symmetry_defect_max = 0.0;             ///< over length
  double out_of_plane_max = 0.0;                ///< of the fiber's own plane, length
  std::optional<double> out_of_flow_plane_max;  ///< length; none where the flow has no plane
  /// Slope 1 / time, from 1e3 times rounding to a tenth of a radius: out of the flow's plane, or where it has none out
  /// of the fiber's own.
  LineFit out_of_plane_growth;
  LineFit deflection_growth;  ///< slope 1 / time, of the first bend that grows: from three times its start to 0.01 L
};

/// The centreline of one fiber through time, moment by moment. Nothing here changes where fiber and flow are turned
/// together.
class FiberHistory {
 public:
  /// @param time_scale  of the motion, 1 / shear rate; > 0, time
  FiberHistory(const Fiber& fiber, const FlowFrame& flow, double time_scale);

  /// Times must grow. @param centreline  [n_sections], length
  void add(double time, std::span<const Vec3> centreline);

  const FlowFrame& flow() const { return flow_; }
  const std::vector<double>& time() const { return time_; }
  const std::vector<Shape>& shapes() const { return shapes_; }
  const std::vector<Regime>& regimes() const { return regimes_; }
  /// [n_moments * n_sections], row by row: signed, 1 / length; and from the first section, length
  const std::vector<double>& curvature() const { return curvature_; }
  const std::vector<double>& arclength() const { return arclength_; }
  /// Of the first section's end, then of the last's; [n_moments]
  const std::vector<std::optional<Hook>>& hooks(FiberEnd end) const { return hooks_[end == FiberEnd::last]; }
  std::vector<double> angles() const;  ///< radians, see measure_angles
  /// Largest distance from the plane of the flow through the fiber's centroid, length. @returns [n_moments], or nothing
  /// where the flow has no plane
  const std::vector<double>& out_of_flow_plane() const { return out_of_flow_plane_; }

  FiberSummary summarize() const;

 private:
  std::vector<ExtremumTrack> make_tracks() const;
  std::optional<Snaking> measure_snaking() const;
  void turn_over();

  Fiber fiber_;
  FlowFrame flow_;
  PlaneTracker plane_;
  double time_scale_;
  int reach_;
  std::vector<double> time_, curvature_, arclength_, out_of_flow_plane_;
  std::vector<Shape> shapes_;
  std::vector<Regime> regimes_;
  std::vector<std::optional<Hook>> hooks_[2];
};

}  // namespace skein
