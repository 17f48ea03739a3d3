#pragma once

#include <skein/core/precision.hpp>
#include <skein/fmm/fmm_plan.hpp>
#include <skein/scene/scene_config.hpp>
#include <skein/scene/scene_file.hpp>

#include <string>
#include <vector>

namespace skein {

/// The method behind a scene's velocities, and why.
struct MobilityChoice {
  bool is_direct = true;
  Precision precision = Precision::automatic;  ///< of direct sums
  FmmOptions fmm;
  std::string reason;  ///< of method = "auto"; else empty
  std::string orbits;  ///< by or for which nodes sums are made in a scene with a symmetry, in words; else empty
};

/// The same on every host, and the same on every device, so that a run can be repeated.
/// @param path  automatic: for where this build's kernels run
MobilityChoice choose_mobility(const SceneConfig& scene, KernelPath path = KernelPath::automatic);

/// One line for direct sums with pairs of this precision; where it is automatic, that is double.
std::string describe_direct_sum(Precision precision);

/// One line: method, order, leaves, expected error, and why.
std::string describe_choice(const MobilityChoice& choice, const SceneConfig& scene);

/// What [hydrodynamics] asks for and no method delivers for these fibers. For read_scene, and again once fibers are
/// placed: whether anything is far enough from anything else is only asked of a scene whose fibers are as written.
std::vector<KeyProblem> find_mobility_problems(const SceneConfig& scene);

}  // namespace skein
