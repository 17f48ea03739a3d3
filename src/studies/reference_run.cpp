#include "studies/reference_run.hpp"

#include <skein/physics/symmetry_check.hpp>

#include <limits>

namespace skein {

Pilot run_reference(SceneConfig scene, const int n_intervals) {
  const SymmetryConfig asked = scene.symmetry;
  scene.symmetry = {.mirror = SymmetryAxis::z, .half_turn = SymmetryAxis::z};
  if (!find_symmetry_problems(scene).empty()) scene.symmetry = asked;
  return run_pilot(scene, n_intervals, std::numeric_limits<double>::infinity());
}

}  // namespace skein
