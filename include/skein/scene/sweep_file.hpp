#pragma once

#include <skein/scene/scene_problem.hpp>

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace skein {

/// What a parameter is in one run.
struct SweepValue {
  std::string text;  ///< as TOML writes it
  double number;     ///< NaN where it is none
  int line, column;  ///< in the sweep's file: of the value, or of the range that it is out of
};

/// A key of the scene that differs from run to run.
struct SweepParameter {
  std::string key;                 ///< as --set names it: "fiber.sections", "fiber[1].roll", "seed"
  std::vector<SweepValue> values;  ///< at least one
  bool is_drawn = false;           ///< at random
  std::size_t axis = 0;            ///< parameters of one axis go along with each other and have as many values
};

/// A curve of what was measured, or a map of it over two parameters.
struct SweepPicture {
  std::string value;         ///< a column of the table
  std::string x;             ///< likewise
  std::string y;             ///< of a map; empty for curves
  std::string by;            ///< a curve for each value of this column; empty for one
  int line = 0, column = 0;  ///< in the sweep\'s file; 0 elsewhere
};

/// Many runs of one scene.
struct SweepConfig {
  std::string title;
  std::filesystem::path scene;                     ///< that all runs are changes of
  std::vector<std::string> changes;                ///< "key=value", the same for all runs and before the parameters
  std::vector<std::pair<int, int>> change_places;  ///< line and column of each
  std::uint64_t seed = 0;                          ///< of values that are drawn
  std::vector<SweepParameter> parameters;
  std::size_t n_axes = 0;
  std::vector<SweepPicture> pictures;  ///< that were asked for
};

/// Most that a sweep may have: numbers of runs have so many digits, and each is validated before the first begins.
inline constexpr std::size_t most_sweep_runs = 100000;

/// Reads a sweep. Ranges and draws have become lists of values; whether a scene can have them is left to the scene's
/// reader.
/// @throws SceneError with every problem of the file, Error(missing_input) if it is not there
SweepConfig read_sweep(const std::filesystem::path& file);

/// "VALUE over X", "VALUE over X by Z" or "VALUE over X and Y". @throws Error(usage) for other words
SweepPicture read_sweep_picture(const std::string& words);

/// Product of the axes' lengths. @param sweep  as it was read
std::size_t count_sweep_runs(const SweepConfig& sweep);

/// Which value each parameter has in a run. Axes count like digits: the last one's values change first.
/// @returns [n_parameters], indices into their values
std::vector<std::size_t> find_sweep_values(const SweepConfig& sweep, std::size_t run);

/// All that makes the run's scene out of the sweep's: the sweep's changes, then a "key=value" for each parameter.
std::vector<std::string> make_sweep_overrides(const SweepConfig& sweep, std::size_t run);

}  // namespace skein
