#pragma once

#include <skein/analysis/line_fit.hpp>

#include <span>
#include <vector>

namespace skein {

/// A place of locally largest |curvature|.
struct CurvatureExtremum {
  double arclength = 0.0;  ///< between sections: of the parabola through three of them
  double curvature = 0.0;  ///< signed, 1 / length
};

/// Extrema that stand out: at least `least` high, and `least_prominence` of their own height above the lower one of the
/// saddles on either side. The two sections at each end are left out, their circles are the least reliable.
std::vector<CurvatureExtremum> find_curvature_extrema(std::span<const double> arclength,
                                                      std::span<const double> signed_curvature, double least,
                                                      double least_prominence = 0.2);

/// One extremum followed through time.
struct ExtremumTrack {
  std::vector<double> time, arclength, curvature;
  bool is_open = true;  ///< while tracking: may go on

  /// Arclength over time while |curvature| is at least half of the track's largest: how an extremum comes and goes is
  /// no wave.
  LineFit fit() const;
};

enum class Wave { standing, travelling, unclear };
const char* name_of(Wave wave);

/// Joins extrema of successive moments that have one sign and lie within `largest_step` of each other, the nearest
/// first. Tracks of fewer than `least_moments` are dropped.
std::vector<ExtremumTrack> track_extrema(std::span<const double> time,
                                         const std::vector<std::vector<CurvatureExtremum>>& extrema,
                                         double largest_step, int least_moments = 5);

/// Travelling: a straight line explains at least 0.8 of the motion, which spans at least `travelling_span` of the
/// fiber's length. Standing: the motion spans less.
inline constexpr double travelling_span = 0.25;
Wave judge_wave(const ExtremumTrack& track, double fiber_length);

}  // namespace skein
