#pragma once

#include "studies/ladder_reach.hpp"
#include "studies/plan_pilots.hpp"

#include <optional>

namespace skein {

/// Chooses the cheapest candidate whose error in the table of convergence leaves room for that of its steps, which
/// pilots of a cheap rung choose. Where numbers of nodes between it and the one below are good enough by a tenth, the
/// first of those. The plan is left without a choice where the table has none, or fibers cross in the chosen one's
/// pilot.
/// @param plan  its candidates are listed
/// @returns the chosen one's pilot; none where there was no time for one
std::optional<Pilot> choose_by_table(const SceneConfig& scene, const LadderReach& reach, PlanPilots& pilots,
                                     Plan& plan);

}  // namespace skein
