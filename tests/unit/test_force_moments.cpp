// Power and particle stress against sums done by hand and a sphere's stresslet.
#include <skein/analysis/force_moments.hpp>

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace skein {
namespace {

TEST(PowerBalance, SumsWithTheirSigns) {
  const std::vector<Vec3> force{{1.0, 2.0, -3.0}, {0.5, 0.0, 4.0}}, induced{{2.0, 1.0, 1.0}, {-2.0, 5.0, 0.5}},
      background{{0.0, 3.0, 0.0}, {1.0, 1.0, 1.0}};
  const PowerBalance power = compute_power_balance(force, induced, background);
  EXPECT_DOUBLE_EQ(power.dissipation, 2.0 + 2.0 - 3.0 - 1.0 + 2.0);
  EXPECT_DOUBLE_EQ(power.background, -(6.0 + 0.5 + 4.0));
  EXPECT_DOUBLE_EQ(power.elastic(), power.background - power.dissipation);
  PowerBalance driven = power;
  driven.drive = 0.7;
  EXPECT_DOUBLE_EQ(driven.elastic(), power.elastic() + 0.7);
}

// A pair of forces f apart by d: S = f d (e_x e_x - I/3) where they pull the fluid together.
TEST(Stresslet, OfAPairOfForces) {
  const std::vector<Vec3> position{{5.3, 1.0, 2.0}, {4.9, 1.0, 2.0}}, force{{-0.7, 0.0, 0.0}, {0.7, 0.0, 0.0}};
  const Matrix3 stresslet = compute_stresslet(compute_symmetric_moment(position, force));
  EXPECT_NEAR(stresslet[0][0], 0.7 * 0.4 * 2.0 / 3.0, 1e-14);
  EXPECT_NEAR(stresslet[1][1], -0.7 * 0.4 / 3.0, 1e-14);
  EXPECT_NEAR(stresslet[0][1], 0.0, 1e-14);
}

// The forces that a rigid sphere of radius a exerts on a fluid strained by E are -5 mu E n per area (n its normal), so
// that S = 20/3 pi mu a^3 E and the viscosity grows by 5/2 of the volume (Einstein 1906, Batchelor 1970).
TEST(Stresslet, OfASphereGivesEinsteinsViscosity) {
  const double radius = 0.3, viscosity = 1.7;
  const Matrix3 strain{{{0.2, 1.25, 0.0}, {1.25, -0.5, 0.4}, {0.0, 0.4, 0.3}}};
  std::vector<Vec3> position, force;
  const int n_heights = 200, n_angles = 40;  // equal areas: slices of equal height
  const double area = 4.0 * std::numbers::pi * radius * radius / (n_heights * n_angles);
  for (int i = 0; i < n_heights; ++i)
    for (int j = 0; j < n_angles; ++j) {
      const double z = -1.0 + 2.0 * (i + 0.5) / n_heights, angle = 2.0 * std::numbers::pi * j / n_angles;
      const double rho = std::sqrt(1.0 - z * z);
      const double n[3] = {rho * std::cos(angle), rho * std::sin(angle), z};
      double f[3] = {};
      for (int a = 0; a < 3; ++a)
        for (int b = 0; b < 3; ++b) f[a] -= 5.0 * viscosity * strain[a][b] * n[b] * area;
      position.push_back({0.1 + radius * n[0], radius * n[1], radius * n[2] - 0.4});
      force.push_back({f[0], f[1], f[2]});
    }
  const Matrix3 stresslet = compute_stresslet(compute_symmetric_moment(position, force));
  const double factor = 20.0 / 3.0 * std::numbers::pi * viscosity * std::pow(radius, 3);
  for (int a = 0; a < 3; ++a)
    for (int b = 0; b < 3; ++b) EXPECT_NEAR(stresslet[a][b], factor * strain[a][b], 1e-3 * factor) << a << b;
  const double volume = 4.0 / 3.0 * std::numbers::pi * std::pow(radius, 3);
  EXPECT_NEAR(compute_viscosity_contribution(stresslet, strain, viscosity), 2.5 * volume, 1e-3 * volume);
  EXPECT_TRUE(std::isnan(compute_viscosity_contribution(stresslet, Matrix3{}, viscosity)));
  const Matrix3 rotation{{{1e-17, -0.7, 0.3}, {0.7, 0.0, -0.2}, {-0.3, 0.2, 0.0}}};
  EXPECT_TRUE(std::isnan(compute_viscosity_contribution(stresslet, rotation, viscosity)));
}

}  // namespace
}  // namespace skein
