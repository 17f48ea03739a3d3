#include <skein/analysis/force_moments.hpp>
#include <skein/core/error.hpp>

#include <limits>

namespace skein {
namespace {

double contract(const Matrix3& a, const Matrix3& b) {
  double sum = 0.0;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) sum += a[i][j] * b[i][j];
  return sum;
}

}  // namespace

PowerBalance compute_power_balance(const std::span<const Vec3> force, const std::span<const Vec3> induced,
                                   const std::span<const Vec3> background) {
  SKEIN_REQUIRE(force.size() == induced.size() && force.size() == background.size(), "one velocity for each force");
  PowerBalance power;
  for (std::size_t i = 0; i < force.size(); ++i) {
    power.dissipation += dot(force[i], induced[i]);
    power.background -= dot(force[i], background[i]);
  }
  return power;
}

Matrix3 compute_stresslet(const SymmetricTensor& moment) {
  Matrix3 stresslet{};
  const double third = (moment[0] + moment[1] + moment[2]) / 3.0;
  for (int a = 0; a < 3; ++a)
    for (int b = 0; b < 3; ++b) stresslet[a][b] = a == b ? third - moment[a] : -moment[6 - a - b];
  return stresslet;
}

double compute_viscosity_contribution(const Matrix3& stresslet, const Matrix3& gradient, const double viscosity) {
  Matrix3 strain_rate{};
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) strain_rate[i][j] = 0.5 * (gradient[i][j] + gradient[j][i]);
  const double strain = contract(strain_rate, strain_rate);
  // A rotation that is not about an axis of space has the strain of its rounding.
  constexpr double negligible = 1e-12;
  if (!(strain > negligible * negligible * contract(gradient, gradient)))
    return std::numeric_limits<double>::quiet_NaN();
  return contract(stresslet, strain_rate) / (2.0 * viscosity * strain);
}

}  // namespace skein
