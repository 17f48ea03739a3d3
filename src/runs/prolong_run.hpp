#pragma once

#include <skein/io/run_folder.hpp>

#include <string>
#include <vector>

namespace skein {

/// A run's scene with its end moved to a later time.
struct LaterEnd {
  std::string text;         ///< of the new scene; empty where the run has that end already, or none was given
  std::string description;  ///< of what is done, for people
};

/// Looks whether a run can go on to another end; nothing is changed.
/// @param overrides  "time.end=14.0", or none
/// @throws Error(usage) if the overrides would change anything else, or make the end earlier; SceneError,
///         Error(scene_error) if they are wrong, or the scene could not be read or computed with that end
LaterEnd find_later_end(const RunFolder& folder, const std::vector<std::string>& overrides);

/// Moves it: scene.toml is replaced as a whole, so that the end is either moved or not, whatever happens.
void move_end(const RunFolder& folder, const LaterEnd& later);

}  // namespace skein
