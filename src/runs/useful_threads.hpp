#pragma once

#include <skein/scene/scene_config.hpp>

#include <string>

namespace skein {

/// How many host threads make a run of this scene faster: one for each 250 nodes, at least one. Fewer nodes keep a
/// second thread less busy than waiting at the end of each kernel costs (docs/performance.md has the times). Where
/// kernels run on a device, as many as there are.
int count_useful_threads(const SceneConfig& scene);

/// A line of a run's first words: how many threads it has, and why.
std::string describe_threads(const SceneConfig& scene);

}  // namespace skein
