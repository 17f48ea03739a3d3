#pragma once

#include <skein/core/vec3.hpp>

#include <cstdint>
#include <string>
#include <vector>

namespace skein::reference {

/// splitmix64: the same numbers on every machine and with every library.
class Random {
 public:
  explicit Random(const std::uint64_t seed) : state_(seed) {}

  std::uint64_t bits();
  double uniform(double low, double high);  ///< [low, high)
  double log_uniform(double low, double high);
  Vec3 in_cube(double half_side);
  Vec3 direction();  ///< of length 1, evenly over the sphere

 private:
  std::uint64_t state_;
};

enum class Cloud { cube, tube, line, cluster };
inline constexpr Cloud all_clouds[] = {Cloud::cube, Cloud::tube, Cloud::line, Cloud::cluster};
std::string name_of(Cloud cloud);

/// Points within about `size` of `center`: anywhere in a cube; on a thin tube bent into a helix, in the order along it
/// as in a fiber; anywhere on a straight line; in five dense clusters, in no order.
std::vector<Vec3> make_cloud(Cloud cloud, int n_points, Vec3 center, double size, Random& random);

/// Vectors with components in [-size, size).
std::vector<Vec3> make_random_vectors(int n_vectors, double size, Random& random);

/// Numbers spread evenly over [low, high) on a logarithmic scale.
std::vector<double> make_random_lengths(int n_lengths, double low, double high, Random& random);

}  // namespace skein::reference
