#include <skein/analysis/section_centroids.hpp>

#include "kernels/section_centroid.hpp"

namespace skein {

std::vector<Vec3> compute_centreline(const std::vector<Fiber>& fibers, const ConstVectors& position) {
  const Vectors centroid("skein::compute_centreline", static_cast<std::size_t>(count_sections(fibers)));
  for (const Fiber& fiber : fibers)
    compute_section_centroids<ExecSpace>(
        ExecSpace(), position,
        {fiber.first_node, fiber.config.sections, fiber.config.nodes_per_section, fiber.config.radius},
        fiber.first_section, centroid);
  return to_host(centroid);
}

}  // namespace skein
