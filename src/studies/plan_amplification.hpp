#pragma once

#include "studies/plan_pilots.hpp"

namespace skein {

/// How much more a scene may make of what coarse tubes have in common than the fibers of the table of convergence do,
/// whose error is multiplied by it. Differences between coarse tubes do not show that error; how the scene answers to a
/// small change does: shapes of tubes of four to twelve nodes were at most 2.2 times as far from those of 24 as a
/// tube's shape moves when its springs are five per cent stiffer, in shear, extension, a U-turn and cellular vortices
/// (docs/resolution.md).
/// @param tube   that the pilot is of
/// @returns infinity where the changed one breaks off, 0 where there was no time for it
double measure_amplification(PlanPilots& pilots, const Candidate& tube, const Pilot& pilot);

}  // namespace skein
