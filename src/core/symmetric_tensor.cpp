#include <skein/core/error.hpp>
#include <skein/core/symmetric_tensor.hpp>

namespace skein {

SymmetricTensor compute_symmetric_moment(const std::span<const Vec3> position, const std::span<const Vec3> force) {
  SKEIN_REQUIRE(position.size() == force.size(), "one force for each position");
  Vec3 middle;
  for (const Vec3 x : position) middle = middle + x / static_cast<double>(position.size());
  SymmetricTensor moment{};
  for (std::size_t i = 0; i < position.size(); ++i) {
    const Vec3 d = position[i] - middle, f = force[i];
    const SymmetricTensor part{d.x * f.x,
                               d.y * f.y,
                               d.z * f.z,
                               0.5 * (d.y * f.z + d.z * f.y),
                               0.5 * (d.x * f.z + d.z * f.x),
                               0.5 * (d.x * f.y + d.y * f.x)};
    for (std::size_t c = 0; c < part.size(); ++c) moment[c] += part[c];
  }
  return moment;
}

}  // namespace skein
