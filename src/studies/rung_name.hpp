#pragma once

#include <string>

namespace skein {

// A rung of the ladder is told by the number of nodes on a section; what has no section comes below those that have.
constexpr int rigid_rung = 0;
constexpr int chain_rung = 1;
constexpr int finest_rung = 24;  ///< which the others are compared with

/// "rigid", "chain", or the number of nodes on a section.
std::string name_of_rung(int rung);
/// @throws Error(usage) naming the ones there are
int read_rung(const std::string& name);

/// In a sentence: "rigid fibers", "a chain", "6 nodes on a section".
std::string describe_rung(int rung);

}  // namespace skein
