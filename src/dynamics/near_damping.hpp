#pragma once

#include <skein/core/vec3.hpp>
#include <skein/solvers/block_band.hpp>

#include <vector>

namespace skein {

/// One fiber as its near damping sees it; on the host.
struct NearFiber {
  int n_sections = 0;
  int nodes_per_section = 0;
  int reach = 0;                                ///< springs join sections up to this far apart
  const double* stiffness = nullptr;            ///< [reach + 1, nodes_per_section], force; 0 means no spring
  const double* inverse_rest_length = nullptr;  ///< the same shape, 1 / length
  const double* section_factor = nullptr;       ///< [n_sections], of the stiffness; null: 1
  double blob = 0.0;                            ///< length
  double viscosity = 0.0;
};

/// The half width of the band that compute_near_damping fills.
inline int near_half_width(const NearFiber& fiber, const int width) { return width + fiber.reach; }

/// Overwrites the band with I - scale M_near dF/dx: M_near is the mobility of nodes at most `width` sections apart,
/// less and less with their distance, in proportion to 1 - |s - s'| / (width + 1). That factor is positive definite as
/// a function of s - s', so that M_near is, too (Schur's product theorem): a sharp cut would not be.
/// @param position  [n_sections nodes_per_section], length
/// @param scale     >= 0, time
void compute_near_damping(const NearFiber& fiber, const std::vector<Vec3>& position, int width, double scale,
                          BlockBand& band);

}  // namespace skein
