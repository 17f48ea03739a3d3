#pragma once

#include <limits>

namespace skein {

/// What a run under error control may choose. All that is chosen from it goes with the units of time and length.
struct ControlOptions {
  double tolerance = 1e-4;                                    ///< error per unit time over the length scale, 1 / time
  double length_scale = 1.0;                                  ///< length
  double detail_scale = 0.0;                                  ///< node spacing, length; 0: not known
  double time_scale = 1.0;                                    ///< of the flow, 1 / shear rate; time
  double fixed_step = 0.0;                                    ///< > 0 switches the error control off
  double max_step = std::numeric_limits<double>::infinity();  ///< time

  /// Root of the error, over the length scale, that the tolerance allows in 0.4 time scales. The steps that go with a
  /// tolerance were measured in shear of rate 2.5, where that is a unit of time.
  double tolerance_root() const;
};

/// The largest step that error control may take: max_step, or less where the tolerance asks for it.
double largest_controlled_step(const ControlOptions& options);

/// The largest step that TR-BDF2 tries, as a part of the flow's time scale: Newton's method needs more and more
/// iterations beyond (39 a step instead of 7 to 10 at a tolerance of 1e-2, L = 0.523), or fails.
inline constexpr double trbdf2_largest_step_ratio = 0.4;

}  // namespace skein
