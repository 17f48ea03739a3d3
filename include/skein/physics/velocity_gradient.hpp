#pragma once

#include <array>

namespace skein {

/// Row i, column j: d u_i / d x_j, 1 / time.
using VelocityGradient = std::array<std::array<double, 3>, 3>;

/// u = (rate y, 0, 0).
VelocityGradient make_shear_gradient(double rate);

/// u = rate (-x, y, 0): compression along x.
VelocityGradient make_planar_extension_gradient(double rate);

/// u = rate (x, -y/2, -z/2): extension along x.
VelocityGradient make_uniaxial_extension_gradient(double rate);

/// u = rate (-y, x, 0): a rigid body that turns about z with this angular velocity.
VelocityGradient make_rotation_gradient(double rate);

}  // namespace skein
