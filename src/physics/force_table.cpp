#include "force_table.hpp"

namespace skein {

ForceList make_forces(const SceneConfig& scene, const std::vector<Fiber>& fibers) {
  ForceList forces;
  for (const auto append : {append_springs, append_bending, append_shear_couple, append_repulsion, append_gravity,
                            append_tethers, append_torques, append_undulations})
    append(scene, fibers, forces);
  return forces;
}

}  // namespace skein
