#pragma once

#include <skein/core/symmetric_tensor.hpp>
#include <skein/core/vec3.hpp>

#include <array>
#include <span>

namespace skein {

/// Row i, column j.
using Matrix3 = std::array<std::array<double, 3>, 3>;

/// Who gives and takes power, force * length / time. The nodes' forces f on the fluid are the sum of conservative ones,
/// which the energy is of, and of others; u = background + M f. So
/// d(energy)/dt = -f.u + drive = background - dissipation + drive.
struct PowerBalance {
  double dissipation = 0.0;  ///< f^T M f >= 0: what the fluid's disturbance turns into heat
  double background = 0.0;   ///< -f . background flow: work of the flow on the fiber
  double drive = 0.0;        ///< what forces without an energy, and moving ends, put in; see Force::add_drive_powers
  double elastic() const { return background - dissipation + drive; }  ///< d(energy)/dt
};

/// Without the drive, which forces know themselves.
/// @param force, induced, background  [n_nodes]: forces on the fluid; the velocity these cause; the background flow
PowerBalance compute_power_balance(std::span<const Vec3> force, std::span<const Vec3> induced,
                                   std::span<const Vec3> background);

/// Particle stress of a fiber: S = -(the symmetric first moment of its forces about its centroid, less a third of its
/// trace). In a suspension of n fibers in a volume the stress is larger by n S (Batchelor 1970). A blob adds nothing:
/// it has no first moment about its node. Where the forces have a sum, as gravity's do, S depends on the point about
/// which the moment is taken, and the centroid is a choice. force * length
/// @param moment  see compute_symmetric_moment
Matrix3 compute_stresslet(const SymmetricTensor& moment);

/// (viscosity - fluid's) / (fluid's * fibers per volume): S:E / (2 mu E:E), length^3; NaN where nothing is strained.
/// E is the symmetric part of the background flow's gradient.
/// @param gradient  G_ij = d u_i / d x_j, 1 / time
double compute_viscosity_contribution(const Matrix3& stresslet, const Matrix3& gradient, double viscosity);

}  // namespace skein
