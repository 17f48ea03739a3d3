#pragma once

#include <skein/core/vec3.hpp>

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace skein {

inline constexpr double largest_coordinate = 1e100;      ///< of a point: squares and cubes of distances stay finite
inline constexpr double largest_number_of_points = 1e8;  ///< that are asked for at once

/// The whole text as a number in C's notation, whatever the language of the system.
/// @returns false, with `number` as it was, where it is none or does not fit into a double
bool parse_number(std::string_view text, double& number);

/// Points from a text: on each line three numbers x, y and z (length) with blanks, a comma or a semicolon between them.
/// Empty lines and what follows a # are passed over; the first line may name the columns x, y and z.
///
/// @throws Error(missing_input) if the file is not there; Error(damaged_data), as file:line:column, at the first thing
///         that is none of this, or if there is no point at all
std::vector<Vec3> read_points(const std::filesystem::path& path);

/// The same for the text of a file; `name` stands for it in messages.
std::vector<Vec3> parse_points(std::string_view text, const std::string& name);

}  // namespace skein
