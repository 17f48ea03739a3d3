#pragma once

#include <skein/scene/scene_config.hpp>

#include "scene_reader.hpp"

#include <vector>

namespace skein {

/// What can only be judged from several keys together. Tables in which a key was wrong are passed over.
void check_scene(const SceneConfig& scene, const SceneReader& reader, std::vector<Problem>& problems,
                 std::vector<Problem>& warnings);

/// The part of check_scene that is about [fiber].
void check_fibers(const SceneConfig& scene, const SceneReader& reader, std::vector<Problem>& problems,
                  std::vector<Problem>& warnings);

/// Of [position, factor] pairs: positions grow from 0 to 1, factors are at least this.
void check_profile(const std::vector<ProfilePoint>& profile, const std::string& path, double least_factor,
                   const SceneReader& reader, std::vector<Problem>& problems);

/// The part of check_scene that is about forces: [repulsion], [gravity], [[tether]], [[torque]], [[undulation]],
/// [[clamp]].
void check_forces(const SceneConfig& scene, const SceneReader& reader, std::vector<Problem>& problems,
                  std::vector<Problem>& warnings);

}  // namespace skein
