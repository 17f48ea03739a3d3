#pragma once

#include "scene_keys.hpp"

#include <fmt/format.h>

namespace skein {

// No scene needs more in any system of units (in SI the springs of an actin filament pull with 1e-17), and products of
// a few such numbers stay far from overflow and underflow.
inline constexpr double largest_number = 1e30;
inline constexpr double smallest_number = 1e-30;

inline Range any_number() { return {-largest_number, largest_number, ""}; }
inline Range above_zero() { return {smallest_number, largest_number, "above 0"}; }
inline Range zero_or_more() { return {0.0, largest_number, "0 or more"}; }
inline Range between(const double low, const double high) { return {low, high, fmt::format("{} to {}", low, high)}; }

}  // namespace skein
