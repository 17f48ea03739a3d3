#include "force_table.hpp"

#include <span>

namespace skein {

void Force::add_moments(const std::vector<Fiber>& fibers, const double time, const ConstVectors& position,
                        std::vector<SymmetricTensor>& moment) const {
  const Vectors force("skein::Force::moment", position.extent(0));
  add_forces(time, position, force);
  const std::vector<Vec3> x = to_host(position), f = to_host(ConstVectors(force));
  for (std::size_t i = 0; i < fibers.size(); ++i) {
    const auto first = static_cast<std::size_t>(fibers[i].first_node),
               n = static_cast<std::size_t>(fibers[i].n_nodes());
    const SymmetricTensor part =
        compute_symmetric_moment(std::span(x).subspan(first, n), std::span(f).subspan(first, n));
    for (std::size_t c = 0; c < part.size(); ++c) moment[i][c] += part[c];
  }
}

ForceList make_forces(const SceneConfig& scene, const std::vector<Fiber>& fibers) {
  ForceList forces;
  for (const auto append : {append_springs, append_bending, append_shear_couple, append_repulsion, append_gravity,
                            append_tethers, append_torques, append_undulations, append_clamps})
    append(scene, fibers, forces);
  return forces;
}

}  // namespace skein
