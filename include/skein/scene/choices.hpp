#pragma once

#include <skein/core/far_field.hpp>
#include <skein/core/precision.hpp>
#include <skein/core/time_method.hpp>

namespace skein {

// What the keys of a scene may choose from. Each enumerator's word, and what it means to a reader, stand in
// src/scene/words.cpp; those that layers without scenes share are in core.

/// The flow far from all fibers; see FlowConfig for the velocities.
enum class FlowKind { shear, planar_extension, uniaxial_extension, rotation, poiseuille, vortices, none };

/// What a fiber is made of.
enum class FiberModel { tube, chain, rigid };

/// Where fibers stand.
enum class PlacementKind { as_written, grid, random };

/// Directions of the fibers that a placement makes.
enum class Orientation { as_written, random };

/// An axis of space that a symmetry of the scene goes with.
enum class SymmetryAxis { none, x, y, z };

/// How the sum over nodes that gives velocities is made.
enum class SumMethod { automatic, direct, fmm };

}  // namespace skein
