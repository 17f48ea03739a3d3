#pragma once

#include <skein/analysis/flow_frame.hpp>
#include <skein/core/vec3.hpp>

#include <span>

namespace skein {

/// The normal of a fiber's own plane from moment to moment, with the sign that makes one curvature of it positive
/// throughout.
///
/// In a flow that turns fibers the normal points to the side of the flow's, wherever it leans to one by more than a
/// tenth. Else it stays on the side of the moment before, and the first strong bend, counted from the first section, of
/// the first moment at which the fiber is bent is positive: of the first bend beyond rounding until one is strong. No
/// choice refers to the axes of space.
class PlaneTracker {
 public:
  explicit PlaneTracker(const FlowFrame& flow) : flow_(flow) {}

  struct Plane {
    Vec3 normal;
    bool turns_over = false;  ///< only now is the sign known, and that of all moments before was the wrong one
  };

  /// @param reach  of the curvature, see choose_curvature_reach
  Plane follow(std::span<const Vec3> centreline, int reach);

 private:
  FlowFrame flow_;
  Vec3 before_;  ///< the normal of the moment before; zero at first
  /// What the sign was chosen by.
  enum class Evidence { none, weak_bend, certain };
  Evidence sign_ = Evidence::none;
};

}  // namespace skein
