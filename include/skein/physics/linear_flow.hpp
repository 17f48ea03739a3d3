#pragma once

#include <skein/physics/background_flow.hpp>

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

/// u = G (x - origin), the same at all times: for programs that need a gradient no scene has a word for.
class LinearFlow : public BackgroundFlow {
 public:
  LinearFlow(const VelocityGradient& gradient, Vec3 origin) : gradient_(gradient), origin_(origin) {}

  void add_velocity(double time, const ConstVectors& position, const Vectors& velocity) const override;
  double typical_rate() const override;  ///< sqrt(2 E : E) with the symmetric part E of G: the shear rate in shear
  double time_scale() const override;
  std::string describe() const override;

 private:
  VelocityGradient gradient_;
  Vec3 origin_;
};

}  // namespace skein
