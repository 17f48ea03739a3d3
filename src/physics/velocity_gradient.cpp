#include <skein/physics/velocity_gradient.hpp>

namespace skein {

VelocityGradient make_shear_gradient(const double rate) {
  return {{{0.0, rate, 0.0}, {0.0, 0.0, 0.0}, {0.0, 0.0, 0.0}}};
}

VelocityGradient make_planar_extension_gradient(const double rate) {
  return {{{-rate, 0.0, 0.0}, {0.0, rate, 0.0}, {0.0, 0.0, 0.0}}};
}

VelocityGradient make_uniaxial_extension_gradient(const double rate) {
  return {{{rate, 0.0, 0.0}, {0.0, -0.5 * rate, 0.0}, {0.0, 0.0, -0.5 * rate}}};
}

VelocityGradient make_rotation_gradient(const double rate) {
  return {{{0.0, -rate, 0.0}, {rate, 0.0, 0.0}, {0.0, 0.0, 0.0}}};
}

}  // namespace skein
