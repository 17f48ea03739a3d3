#pragma once

#include "studies/plan.hpp"

#include <vector>

namespace skein {

/// Rigid fibers, the chain, the tubes of the ladder, and the scene's own where it is finer: from coarse to fine. Errors
/// are not a number yet; a rung that cannot stand for the scene's fibers is barred, with the reason as its verdict.
/// @param scene  its fibers are as written
/// @throws Error(scene_error) where no rung that bends can
std::vector<Candidate> list_candidates(const SceneConfig& scene);

/// One of them, or a tube between them.
Candidate make_candidate(const SceneConfig& scene, int rung);

/// Wall times of those that no pilot measured, by the pairs of a direct sum beside the finest that one did.
void estimate_seconds(std::vector<Candidate>& candidates);

}  // namespace skein
