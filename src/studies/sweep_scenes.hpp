#pragma once

#include <skein/scene/sweep_file.hpp>

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

namespace skein {

/// What a sweep is made of, word for word.
struct SweepTexts {
  std::string sweep, base_scene;
  std::string start;  ///< bytes of the state of another run (io/start_file) that the base scene begins with; or empty
};
/// @throws SceneError if the first run's scene is not sound
SweepTexts read_sweep_texts(const std::filesystem::path& file, const SweepConfig& sweep);

/// "fiber.sections=57, fiber.roll=5.0"
std::string describe_sweep_run(const SweepConfig& sweep, std::size_t run);

/// "0042"
std::string name_sweep_run(std::size_t run);

/// Reads the scenes of all runs.
/// @throws SceneError with their problems, each once: at the value of the sweep's file that is wrong, or in the base
///         scene with the first run that has it
void check_sweep_scenes(const std::filesystem::path& file, const SweepConfig& sweep);

}  // namespace skein
