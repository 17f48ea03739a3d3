#pragma once

#include <skein/scene/scene_config.hpp>
#include <skein/scene/scene_file.hpp>

#include <vector>

namespace skein {

/// What keeps a scene from the symmetry that it claims: fibers whose nodes have no partners, a flow, gravity, tethers
/// or torques that are not mapped onto themselves. One problem at most for each of the keys of [symmetry].
/// @param scene  with its fibers where placement put them, chains with numbers of their own
std::vector<KeyProblem> find_symmetry_problems(const SceneConfig& scene);

}  // namespace skein
