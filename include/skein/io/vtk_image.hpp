#pragma once

#include <skein/core/vec3.hpp>

#include <array>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace skein {

/// Points of a regular grid along x, y and z: origin + (i, j, k) spacing, i running fastest.
struct ImageGrid {
  Vec3 origin;                    ///< length
  Vec3 spacing{1.0, 1.0, 1.0};    ///< length, along each axis
  std::array<int, 3> n_points{};  ///< a plane has one point along its normal

  std::int64_t size() const { return std::int64_t{n_points[0]} * n_points[1] * n_points[2]; }
  Vec3 point(std::int64_t index) const;
};

/// Vectors on the points of a grid, [grid.size()].
struct ImageField {
  std::string name;
  std::vector<Vec3> values;
};

/// Writes a VTK XML ImageData file (.vti), binary and whole or not at all, which ParaView and VTK read.
/// @param time  is kept as the field data "TimeValue"
/// @throws Error(io_error)
void write_vtk_image(const std::filesystem::path& path, const ImageGrid& grid, double time,
                     const std::vector<ImageField>& fields);

}  // namespace skein
