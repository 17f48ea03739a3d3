#pragma once

#include <skein/core/vec3.hpp>
#include <skein/fibers/fiber.hpp>

#include <span>
#include <vector>

namespace skein {

/// The centroids of one fiber's sections in a list of all sections'.
inline std::span<const Vec3> centreline_of(const Fiber& fiber, const std::vector<Vec3>& centreline) {
  return std::span(centreline).subspan(fiber.first_section, fiber.config.sections);
}

/// Unsigned curvature at each section: of the circle through it and the sections `reach` before and after it, fewer
/// near an end. End sections take the value of their neighbour; a fiber of two sections is straight.
/// @returns [n_sections of the fiber], 1 / length
std::vector<double> compute_curvature(std::span<const Vec3> centreline, int reach = 2);

/// Sum of the distances between neighbouring centroids, length; at rest (N_f - 1) / N_f of the fiber's length.
double compute_length(std::span<const Vec3> centreline);

/// From the first section to the last, length.
Vec3 compute_end_to_end(std::span<const Vec3> centreline);

}  // namespace skein
