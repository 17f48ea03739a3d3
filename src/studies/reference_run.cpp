#include "studies/reference_run.hpp"

#include <skein/physics/symmetry_check.hpp>

#include <limits>

namespace skein {

Pilot run_reference(SceneConfig scene, const int n_intervals) {
  const SymmetryConfig asked = scene.symmetry;
  using enum SymmetryAxis;
  for (const SymmetryConfig& tried : {SymmetryConfig{z, z}, SymmetryConfig{z, none}, SymmetryConfig{none, z}, asked}) {
    scene.symmetry = tried;
    if (find_symmetry_problems(scene).empty()) break;
  }
  return run_pilot(scene, n_intervals, std::numeric_limits<double>::infinity());
}

}  // namespace skein
