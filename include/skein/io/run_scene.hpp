#pragma once

#include <skein/io/run_folder.hpp>
#include <skein/scene/scene_config.hpp>

namespace skein {

/// The scene of a run folder.
/// @throws Error(missing_input), Error(io_error) if scene.toml cannot be read, SceneError if it is no scene
SceneConfig read_run_scene(const RunFolder& folder);

/// A run's frames are of the scene with which it began: the index keeps that scene's text, and scene.toml must still be
/// it, or what became of it when the run's end was moved. Nothing is compared where there is no index yet, or one that
/// is damaged; the chain of segments tells, too.
/// @throws Error(damaged_data) if scene.toml is another text; as read_run_scene
void check_scene_is_of_run(const RunFolder& folder);

}  // namespace skein
