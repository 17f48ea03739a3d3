#pragma once

// What the operators and the passes know of a box, in half-widths. Nothing of Kokkos and nothing of Eigen.

namespace skein {

inline constexpr double inner_surface = 1.05;  ///< half-widths: sources' equivalent surface, targets' check surface
inline constexpr double outer_surface = 2.95;  ///< sources' check surface, targets' equivalent surface

}  // namespace skein
