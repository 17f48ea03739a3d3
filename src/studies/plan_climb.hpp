#pragma once

#include "studies/plan_pilots.hpp"

#include <optional>

namespace skein {

/// Climbs the ladder of a plan's candidates by pilot runs, until one is good enough: it becomes the chosen one.
///
/// From the lowest rung to the first that is good enough. The difference from the next one tells a rung that is not;
/// one that may be is taken where the table's error of the next still fits in, and is set against a finer one else:
/// what coarse tubes have in common, no difference between them shows.
/// @param scene     its times are resolved
/// @param plan      its candidates are listed, its steps chosen
/// @param coarsest  the lowest candidate that bends
/// @param known     a pilot of that candidate that has run already
/// @returns the chosen one's pilot; none where none is good enough
std::optional<Pilot> climb_ladder(const SceneConfig& scene, PlanPilots& pilots, Plan& plan, std::size_t coarsest,
                                  std::optional<Pilot> known);

}  // namespace skein
