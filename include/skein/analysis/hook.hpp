#pragma once

#include <skein/analysis/circle_fit.hpp>
#include <skein/analysis/signed_curvature.hpp>

#include <optional>
#include <span>

namespace skein {

/// A bent end of a fiber: the J of a snake turn.
struct Hook {
  Bend bend;
  Circle circle;           ///< through the sections at which the curvature exceeds half of its peak
  double arclength = 0.0;  ///< of the peak, from the fiber's end that the hook belongs to
};

enum class FiberEnd { first, last };

/// Turning from which a bent end is a hook: its end has turned about.
inline constexpr double least_hook_turning = 1.5708;

/// The bend nearest to an end, if it turns enough and has its peak in that half of the fiber.
/// @param centreline, arclength, signed_curvature  [n_sections], of one fiber
std::optional<Hook> find_hook(std::span<const Vec3> centreline, std::span<const double> arclength,
                              std::span<const double> signed_curvature, FiberEnd end,
                              double least_turning = least_hook_turning);

}  // namespace skein
