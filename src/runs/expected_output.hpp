#pragma once

#include <skein/fibers/fiber.hpp>
#include <skein/scene/scene_config.hpp>

#include <cstddef>
#include <string>
#include <vector>

namespace skein {

/// What a run is expected to take until its end.
struct Expectation {
  double steps = 0.0;
  double seconds = 0.0;              ///< wall time; not a number where it is unknown
  std::size_t checkpoint_bytes = 0;  ///< of one checkpoint
};

/// Frames and megabytes of a run folder, in words: all its files, those of steps apart, since their number is not known
/// beforehand as that of frames is.
std::string describe_expected_output(const SceneConfig& scene, const std::vector<Fiber>& fibers,
                                     const Expectation& expectation);

}  // namespace skein
