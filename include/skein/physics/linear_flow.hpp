#pragma once

#include <skein/physics/background_flow.hpp>

namespace skein {

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
  VelocityGradient gradient(double, Vec3) const override { return gradient_; }
  double typical_rate() const override;  ///< sqrt(2 E : E) with the symmetric part E of G: the shear rate in shear
  double time_scale() const override;
  std::string describe() const override;

 private:
  VelocityGradient gradient_;
  Vec3 origin_;
};

}  // namespace skein
