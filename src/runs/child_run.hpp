#pragma once

#include "runs/placed_scene.hpp"

#include <filesystem>
#include <string>
#include <vector>

namespace skein {

/// A run that is not begun yet.
struct NewRun {
  PlacedScene placed;
  std::string start;          ///< bytes of the state of another run; empty where the fibers start as they are written
  std::string what_happened;  ///< see ParentState
  std::string parent{};       ///< folder of the earlier run; empty where the scene is not continued from one
};

/// Of a scene's file: see read_placed_scene. If the scene is that of a run that began with another one's state, so does
/// this one, and the state's file lies beside it.
NewRun make_new_run(const std::filesystem::path& scene, const std::vector<std::string>& overrides);

/// Of a run that begins with the state of an earlier one, at the time of that state.
/// @param parent  see read_parent_state
/// @param scene   a file, whose fibers must have the same sections and nodes; empty: the earlier run's own
/// @throws Error(usage), SceneError, and what read_parent_state throws
NewRun make_child_run(const std::string& parent, const std::filesystem::path& scene,
                      const std::vector<std::string>& overrides);

}  // namespace skein
