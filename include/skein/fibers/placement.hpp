#pragma once

#include <skein/fibers/fiber.hpp>
#include <skein/scene/scene_config.hpp>
#include <skein/scene/scene_file.hpp>

#include <vector>

namespace skein {

/// The scene with every copy that its placement asks for listed as a fiber of its own, so that it is "as_written". A
/// random place depends on the seed and the fiber's number alone, and on the fibers before it where they are in the
/// way.
/// @throws Error(scene_error) if random fibers do not fit, with how many did
SceneConfig place_fibers(const SceneConfig& scene);

/// Which fibers overlap at the start with one before them, their ends being flat: at most one problem for each fiber as
/// it is written, and one for a grid, whose copies stand too near.
/// @param scene   as it is written
/// @param placed  its fibers where place_fibers puts them
std::vector<KeyProblem> find_overlap_problems(const SceneConfig& scene, const std::vector<Fiber>& placed);

}  // namespace skein
