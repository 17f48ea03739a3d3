#pragma once

#include <skein/analysis/flow_frame.hpp>

namespace skein {

/// (2.5 y, 0, 0), the paper's.
inline constexpr Matrix3 shear_gradient = {{{0.0, 2.5, 0.0}, {0.0, 0.0, 0.0}, {0.0, 0.0, 0.0}}};

/// (-x, y, 0).
inline constexpr Matrix3 compression_gradient = {{{-1.0, 0.0, 0.0}, {0.0, 1.0, 0.0}, {0.0, 0.0, 0.0}}};

/// (x, -y/2, -z/2).
inline constexpr Matrix3 uniaxial_gradient = {{{1.0, 0.0, 0.0}, {0.0, -0.5, 0.0}, {0.0, 0.0, -0.5}}};

/// (-y, x, 0).
inline constexpr Matrix3 rotation_gradient = {{{0.0, -1.0, 0.0}, {1.0, 0.0, 0.0}, {0.0, 0.0, 0.0}}};

}  // namespace skein
