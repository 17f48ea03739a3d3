#pragma once

#include <skein/core/vec3.hpp>

#include <array>
#include <span>

namespace skein {

/// Row i, column j.
using Matrix3 = std::array<std::array<double, 3>, 3>;

/// Who gives and takes power, force * length / time. The springs' forces f are the nodes' forces on the fluid and
/// u = background + M f, so that d(elastic energy)/dt = -f.u = background - dissipation.
struct PowerBalance {
  double dissipation = 0.0;  ///< f^T M f >= 0: what the fluid's disturbance turns into heat
  double background = 0.0;   ///< -f . background flow: work of the flow on the fiber
  double elastic() const { return background - dissipation; }  ///< d(elastic energy)/dt
};

/// @param force, induced, background  [n_nodes]: forces on the fluid; the velocity these cause; the background flow
PowerBalance compute_power_balance(std::span<const Vec3> force, std::span<const Vec3> induced,
                                   std::span<const Vec3> background);

/// Particle stress of forces without sum: S = -sum of the symmetric part of (x - centroid) f, less a third of its
/// trace. In a suspension of n fibers in a volume the stress is larger by n S (Batchelor 1970). A blob adds nothing: it
/// has no first moment about its node. force * length
Matrix3 compute_stresslet(std::span<const Vec3> position, std::span<const Vec3> force);

/// (viscosity - fluid's) / (fluid's * fibers per volume): S:E / (2 mu E:E), length^3; NaN where nothing is strained.
/// @param strain_rate  E, symmetric, of the background flow, 1 / time
double compute_viscosity_contribution(const Matrix3& stresslet, const Matrix3& strain_rate, double viscosity);

}  // namespace skein
