#pragma once

#include <skein/io/trajectory.hpp>
#include <skein/physics/physics.hpp>

#include "runs/run_analysis.hpp"

#include <vector>

namespace skein {

/// What forces and fluid do at the positions of a frame. Needs Kokkos. @returns [n_fibers]
std::vector<ForceRecord> probe_forces(const Physics& physics, const Frame& frame);

}  // namespace skein
