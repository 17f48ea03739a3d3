#include "tests/reference/point_cloud.hpp"

#include <cmath>
#include <numbers>

namespace skein::reference {

std::uint64_t Random::bits() {
  state_ += 0x9e3779b97f4a7c15u;
  std::uint64_t z = state_;
  z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
  z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
  return z ^ (z >> 31);
}

double Random::uniform(const double low, const double high) {
  return low + (high - low) * static_cast<double>(bits() >> 11) * 0x1p-53;
}

double Random::log_uniform(const double low, const double high) {
  return std::exp(uniform(std::log(low), std::log(high)));
}

Vec3 Random::in_cube(const double half_side) {
  const double x = uniform(-half_side, half_side), y = uniform(-half_side, half_side);
  return {x, y, uniform(-half_side, half_side)};
}

Vec3 Random::direction() {
  const double z = uniform(-1.0, 1.0), angle = uniform(0.0, 2.0 * std::numbers::pi);
  const double across = std::sqrt(1.0 - z * z);
  return {across * std::cos(angle), across * std::sin(angle), z};
}

std::string name_of(const Cloud cloud) {
  switch (cloud) {
    case Cloud::cube:
      return "cube";
    case Cloud::tube:
      return "tube";
    case Cloud::line:
      return "line";
    case Cloud::cluster:
      return "cluster";
  }
  return "unknown";
}

std::vector<Vec3> make_cloud(const Cloud cloud, const int n_points, const Vec3 center, const double size,
                             Random& random) {
  std::vector<Vec3> point;
  const Vec3 axis = random.direction();
  std::vector<Vec3> seed;
  for (int k = 0; k < 5; ++k) seed.push_back(random.in_cube(0.9 * size));
  for (int i = 0; i < n_points; ++i) {
    Vec3 from_center;
    if (cloud == Cloud::cube) from_center = random.in_cube(size);
    if (cloud == Cloud::tube) {
      const double along = (i + random.uniform(0.0, 1.0)) / n_points, turn = 4.0 * std::numbers::pi * along;
      const Vec3 helix{0.6 * std::cos(turn), 0.6 * std::sin(turn), 1.6 * along - 0.8};
      from_center = size * (helix + 0.05 * random.direction());
    }
    if (cloud == Cloud::line) from_center = random.uniform(-size, size) * axis;
    if (cloud == Cloud::cluster) from_center = seed[random.bits() % seed.size()] + random.in_cube(0.02 * size);
    point.push_back(center + from_center);
  }
  return point;
}

std::vector<Vec3> make_random_vectors(const int n_vectors, const double size, Random& random) {
  std::vector<Vec3> vectors;
  for (int i = 0; i < n_vectors; ++i) vectors.push_back(random.in_cube(size));
  return vectors;
}

std::vector<double> make_random_lengths(const int n_lengths, const double low, const double high, Random& random) {
  std::vector<double> lengths;
  for (int i = 0; i < n_lengths; ++i) lengths.push_back(random.log_uniform(low, high));
  return lengths;
}

}  // namespace skein::reference
