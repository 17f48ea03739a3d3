#pragma once

#include <string>
#include <vector>

namespace skein {

/// Insertions, deletions, replacements and swaps of neighbours that turn one word into the other.
int compute_edit_distance(const std::string& a, const std::string& b);

/// The known name that was probably meant, without regard to case; empty if none is near.
std::string find_nearest_name(const std::string& name, const std::vector<std::string>& known);

}  // namespace skein
