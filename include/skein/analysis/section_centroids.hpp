#pragma once

#include <skein/arrays/types.hpp>
#include <skein/fibers/fiber.hpp>

#include <vector>

namespace skein {

/// Centroids of all sections of all fibers, computed on the device. @returns [n_sections], length
std::vector<Vec3> compute_centreline(const std::vector<Fiber>& fibers, const ConstVectors& position);

}  // namespace skein
