#pragma once

#include <skein/scene/sweep_file.hpp>

#include "scene_reader.hpp"
#include "scene_value.hpp"

#include <string>
#include <vector>

namespace skein {

/// A [[parameter]] of a sweep's file.
struct ReadParameter {
  SweepParameter parameter;  ///< whose axis is not known yet
  std::string with;          ///< the key of the parameter that it goes along with; empty for none
  const SceneValue* table;   ///< for what is found wrong later
};

/// @param seed  of values that are drawn
/// @param problems  get what is wrong with it; values may then be missing
ReadParameter read_sweep_parameter(const SceneValue& table, std::uint64_t seed, const SceneSource& source,
                                   std::vector<Problem>& problems);

}  // namespace skein
