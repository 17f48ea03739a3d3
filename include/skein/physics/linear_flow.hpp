#pragma once

#include <skein/physics/background_flow.hpp>

namespace skein {

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
