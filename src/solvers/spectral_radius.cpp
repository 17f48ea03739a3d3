#include <skein/solvers/spectral_radius.hpp>

#include <cmath>
#include <random>
#include <vector>

namespace skein {
namespace {

/// Node-to-node noise: rich in the short waves that the largest eigenvalues belong to.
std::vector<Vec3> make_noise(const int n_nodes, const std::uint64_t seed) {
  std::mt19937_64 random(seed);
  const auto draw = [&random] { return static_cast<double>(random() >> 11) * 0x1p-52 - 1.0; };  // [-1, 1)
  std::vector<Vec3> noise(static_cast<std::size_t>(n_nodes));
  for (Vec3& v : noise) {
    v.x = draw();
    v.y = draw();
    v.z = draw();
  }
  return noise;
}

}  // namespace

SpectralRadius::SpectralRadius(const int n_nodes, const double displacement, const std::uint64_t seed,
                               NodeVectors& vectors)
    : vectors_(vectors),
      displacement_(displacement),
      direction_(vectors.make("skein::SpectralRadius::direction", n_nodes)),
      displaced_(vectors.make("skein::SpectralRadius::displaced", n_nodes)),
      displaced_velocity_(vectors.make("skein::SpectralRadius::displaced_velocity", n_nodes)) {
  vectors.scatter(to_device("skein::SpectralRadius::noise", make_noise(n_nodes, seed)), direction_);
  vectors.combine(direction_, {{1.0 / vectors.root_mean_square(direction_), direction_}, {0.0, direction_}});
}

double SpectralRadius::estimate(RightHandSide& rhs, const double time, const ConstVectors& position,
                                const ConstVectors& velocity, const double accuracy, const int max_iterations) {
  double radius = 0.0;
  for (int iteration = 0; iteration < max_iterations; ++iteration) {
    vectors_.combine(displaced_, {{1.0, position}, {displacement_, direction_}});
    rhs.compute_velocity(time, displaced_, displaced_velocity_);
    const Vectors& change = displaced_velocity_;
    vectors_.combine(change, {{1.0 / displacement_, displaced_velocity_}, {-1.0 / displacement_, velocity}});
    const double size = vectors_.root_mean_square(change);
    // The vector stays as it was: one that is zero or not finite would spoil every later estimate.
    if (!(size > 0.0) || !std::isfinite(size)) return size;
    vectors_.combine(direction_, {{1.0 / size, change}, {0.0, change}});
    const bool settled = iteration > 0 && std::abs(size - radius) <= accuracy * size;
    radius = size;
    if (settled) break;
  }
  return radius;
}

}  // namespace skein
