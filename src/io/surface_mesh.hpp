#pragma once

#include <skein/fibers/fiber.hpp>

#include <array>
#include <cstdint>
#include <vector>

namespace skein {

/// Four nodes each, counterclockwise seen from outside: the tubes between sections, closed by a cap at either end.
/// Caps are cut into quadrilaterals too, so that one kind of cell serves; where nodes_per_section is odd the last one
/// of a cap is a triangle that repeats its last node. A chain has no surface; its links are quadrilaterals that repeat
/// both ends, so that readers show lines.
/// @returns [n_quads]
std::vector<std::array<std::int32_t, 4>> make_surface_mesh(const std::vector<Fiber>& fibers);

/// Of that mesh.
std::size_t count_surface_quads(const std::vector<Fiber>& fibers);

}  // namespace skein
