#include "tests/reference/regularized_stokeslet_reference.hpp"

#include <cmath>
#include <limits>
#include <stdexcept>

namespace skein::reference {

std::vector<Vec3> compute_stokeslet_velocity(const PointForces& sources, const std::vector<Vec3>& target,
                                             const double viscosity) {
  using Long = long double;
  const std::size_t n_sources = sources.position.size();
  if (sources.force.size() != n_sources || sources.blob.size() != n_sources)
    throw std::invalid_argument("positions, forces and blobs differ in number");
  const Long eight_pi_viscosity = 8 * std::acos(Long(-1)) * viscosity;
  std::vector<Vec3> velocity;
  for (const Vec3 x : target) {
    Long u = 0, v = 0, w = 0;
    for (std::size_t s = 0; s < n_sources; ++s) {
      const Vec3 y = sources.position[s], f = sources.force[s];
      const Long a = Long(x.x) - y.x, b = Long(x.y) - y.y, c = Long(x.z) - y.z;
      const Long e2 = Long(sources.blob[s]) * sources.blob[s];
      const Long r2 = a * a + b * b + c * c;
      const Long h1 = (r2 + 2 * e2) / ((r2 + e2) * std::sqrt(r2 + e2));
      const Long h2 = (f.x * a + f.y * b + f.z * c) / ((r2 + e2) * std::sqrt(r2 + e2));
      u += h1 * f.x + h2 * a;
      v += h1 * f.y + h2 * b;
      w += h1 * f.z + h2 * c;
    }
    velocity.push_back({static_cast<double>(u / eight_pi_viscosity), static_cast<double>(v / eight_pi_viscosity),
                        static_cast<double>(w / eight_pi_viscosity)});
  }
  return velocity;
}

double relative_error(const std::vector<Vec3>& actual, const std::vector<Vec3>& expected) {
  if (actual.size() != expected.size()) throw std::invalid_argument("lists differ in length");
  double difference = 0.0, size = 0.0;
  for (std::size_t i = 0; i < actual.size(); ++i) {
    const double d = norm(actual[i] - expected[i]), e = norm(expected[i]);
    if (std::isnan(d)) return std::numeric_limits<double>::quiet_NaN();
    difference = std::fmax(difference, d);
    size = std::fmax(size, e);
  }
  return difference == 0.0 ? 0.0 : difference / size;
}

double inner_product(const std::vector<Vec3>& a, const std::vector<Vec3>& b) {
  if (a.size() != b.size()) throw std::invalid_argument("lists differ in length");
  long double sum = 0;
  for (std::size_t i = 0; i < a.size(); ++i)
    sum += static_cast<long double>(a[i].x) * b[i].x + static_cast<long double>(a[i].y) * b[i].y +
           static_cast<long double>(a[i].z) * b[i].z;
  return static_cast<double>(sum);
}

double norm_of(const std::vector<Vec3>& v) { return std::sqrt(inner_product(v, v)); }

std::vector<Vec3> shifted(const std::vector<Vec3>& x, const double h, const std::vector<Vec3>& v) {
  std::vector<Vec3> result = x;
  for (std::size_t i = 0; i < x.size(); ++i) result[i] = x[i] + h * v[i];
  return result;
}

}  // namespace skein::reference
