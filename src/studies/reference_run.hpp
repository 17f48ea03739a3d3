#pragma once

#include "runs/pilot.hpp"

namespace skein {

/// The pilot that others are compared with, by a quarter of its nodes and their images about z where the scene is
/// symmetric so: what it costs is not the question, and the answers are the same but for rounding. Needs Kokkos.
/// @param scene  as of run_pilot
Pilot run_reference(SceneConfig scene, int n_intervals);

}  // namespace skein
