#pragma once

#include "runs/run_analysis.hpp"

#include <limits>
#include <string>

namespace skein {

/// How surfaces met in a run, from frame to frame. Times are not a number where it did not come to that.
struct ContactRecord {
  double first_inside = std::numeric_limits<double>::quiet_NaN();
  double first_crossing = std::numeric_limits<double>::quiet_NaN();
  /// Of the deepest node inside of another surface, over the smallest radius; of chains, which have no surface, how far
  /// the tubes about them overlap.
  double depth = 0.0;
  double smallest_gap = 0.0;  ///< over the smallest radius

  bool has_crossed() const { return first_crossing == first_crossing; }
};

/// @param analysis  of a frame at least
ContactRecord record_contact(const RunAnalysis& analysis);

/// A clause: "surfaces stay 2.1 radii apart", "... pressed into each other from t = 14 on ...".
std::string describe_contact(const ContactRecord& contact);

}  // namespace skein
