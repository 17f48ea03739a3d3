#pragma once

#include <skein/core/vec3.hpp>
#include <skein/fibers/fiber.hpp>

#include <vector>

namespace skein {

/// Two centrelines that come nearer than this share of the thinner fiber's radius meet.
inline constexpr double meeting_distance = 1e-3;

/// How often centrelines passed through each other, or distant parts of one through each other (see
/// Fiber::distant_sections), between two moments, while every centroid moved straight. Each passage counts once, there
/// and back twice. Centrelines that meet and stay so, as those of planar fibers that come to lie across each other,
/// have crossed once, when they met; those in one plane that do not meet have not.
/// @param before, after  centroids of all sections, [n_sections], length
int count_crossings(const std::vector<Fiber>& fibers, const std::vector<Vec3>& before, const std::vector<Vec3>& after);

}  // namespace skein
