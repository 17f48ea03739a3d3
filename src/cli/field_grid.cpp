#include "cli/field_grid.hpp"

#include <skein/core/error.hpp>
#include <skein/io/point_file.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace skein {
namespace {

constexpr double margin = 0.25;  ///< of the fibers' extent, where no box is given

struct Plane {
  int normal;
  double offset;
};

void check_coordinate(const std::string& option, const double coordinate) {
  if (!(std::abs(coordinate) <= largest_coordinate))
    throw Error(ExitCode::usage, fmt::format("{}: {:g} is no coordinate: a finite number of at most {:g} is one",
                                             option, coordinate, largest_coordinate));
}

Plane parse_plane(const std::string& text) {
  const char axis = text.empty() ? ' ' : text[0];
  if (axis < 'x' || axis > 'z' || (text.size() > 1 && text[1] != '='))
    throw Error(ExitCode::usage, fmt::format("--plane {} is none: write x, y or z, or z=0.1", text));
  if (text.size() == 1) return {axis - 'x', 0.0};
  double offset = 0.0;
  if (!parse_number(std::string_view(text).substr(2), offset))
    throw Error(ExitCode::usage, fmt::format("--plane {}: '{}' is no number", text, text.substr(2)));
  check_coordinate("--plane", offset);
  return {axis - 'x', offset};
}

using Corners = std::array<std::array<double, 2>, 3>;  ///< by axis: low and high

Corners find_corners(const std::vector<Vec3>& nodes) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  Corners corners;
  corners.fill({infinity, -infinity});
  for (const Vec3 node : nodes) {
    const double value[] = {node.x, node.y, node.z};
    for (int axis = 0; axis < 3; ++axis)
      corners[axis] = {std::min(corners[axis][0], value[axis]), std::max(corners[axis][1], value[axis])};
  }
  double longest = 0.0;
  for (const auto& [low, high] : corners) longest = std::max(longest, high - low);
  for (auto& [low, high] : corners) {
    low -= margin * longest;
    high += margin * longest;
  }
  return corners;
}

void take_box(const std::vector<double>& box, Corners& corners) {
  for (std::size_t i = 0; i < box.size(); ++i) {
    check_coordinate("--box", box[i]);
    corners[i / 2][i % 2] = box[i];
  }
  for (const auto& [low, high] : corners)
    if (low > high) throw Error(ExitCode::usage, fmt::format("--box: {:g} is above {:g}", low, high));
}

/// Points from side to side, and their distance: at most `spacing`, and as large as possible.
struct Division {
  int n_points = 1;
  double spacing;
};

Division divide(const double low, const double high, const double spacing) {
  if (low == high) return {1, spacing};
  constexpr double rounding = 1e-9;  // of a number of intervals that is whole but for its last digits
  const int n_intervals = std::max(1, static_cast<int>(std::ceil((high - low) / spacing - rounding)));
  const double divided = (high - low) / n_intervals;
  if (divided < 4.0 * std::numeric_limits<double>::epsilon() * std::max(std::abs(low), std::abs(high)))
    throw Error(ExitCode::usage,
                fmt::format("{} points from {} to {} cannot be told apart: ask for fewer with --points",
                            n_intervals + 1, low, high));
  return {n_intervals + 1, divided};
}

}  // namespace

ImageGrid make_field_grid(const FieldBounds& bounds, const std::vector<Vec3>& nodes) {
  Corners corners = find_corners(nodes);
  take_box(bounds.box, corners);
  const bool is_plane = !bounds.plane.empty() || bounds.box.empty();
  if (is_plane) {
    const Plane plane = parse_plane(bounds.plane.empty() ? "z" : bounds.plane);
    corners[plane.normal] = {plane.offset, plane.offset};
  }
  double longest = 0.0;
  for (const auto& [low, high] : corners) longest = std::max(longest, high - low);
  if (!(longest > 0.0)) throw Error(ExitCode::usage, "--box has no extent");
  const int n_longest = bounds.points > 0 ? bounds.points : is_plane ? 200 : 64;
  ImageGrid grid;
  grid.origin = {corners[0][0], corners[1][0], corners[2][0]};
  double spacing[3], n_points = 1.0;
  for (int axis = 0; axis < 3; ++axis) {
    const Division division = divide(corners[axis][0], corners[axis][1], longest / (n_longest - 1));
    grid.n_points[axis] = division.n_points;
    spacing[axis] = division.spacing;
    n_points *= division.n_points;
  }
  grid.spacing = {spacing[0], spacing[1], spacing[2]};
  if (n_points > largest_number_of_points)
    throw Error(ExitCode::usage, fmt::format("{:.3g} points are more than {:g}: ask for fewer with --points", n_points,
                                             largest_number_of_points));
  return grid;
}

}  // namespace skein
