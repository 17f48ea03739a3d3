#pragma once

#include <skein/core/vec3.hpp>
#include <skein/fibers/fiber.hpp>

#include <span>
#include <vector>

namespace skein {

/// Distance along the centreline from the first section to each section. @returns [n_sections], length
std::vector<double> compute_arclength(std::span<const Vec3> centreline);

/// Sections between the points of the circle that gives a curvature: about 0.7 radii. A shorter chord sees sections
/// deform by themselves, a longer one flattens the sharpest bends a tube can have.
int choose_curvature_reach(const Fiber& fiber);

/// Curvature of compute_curvature with a sign: positive where the line turns counter-clockwise about `normal`, going
/// from the first section to the last.
/// @returns [n_sections], 1 / length
std::vector<double> compute_signed_curvature(std::span<const Vec3> centreline, int reach, Vec3 normal);

/// A part of the line that turns one way.
struct Bend {
  int first = 0, last = 0;  ///< sections
  int peak = 0;             ///< section of the largest |curvature|
  double place = 0.0;       ///< of the peak, along the line, length
  double turning = 0.0;     ///< angle between the tangents at its ends, radians, with the curvature's sign
};

/// All bends that turn by at least `least_turning`, from the first section to the last.
std::vector<Bend> find_bends(std::span<const double> arclength, std::span<const double> signed_curvature,
                             double least_turning);

/// Integral of the unsigned curvature over arclength, radians.
double compute_total_turning(std::span<const double> arclength, std::span<const double> curvature);

}  // namespace skein
