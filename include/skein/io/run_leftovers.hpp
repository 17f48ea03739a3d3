#pragma once

#include <skein/io/run_folder.hpp>

#include <cstdint>
#include <filesystem>
#include <vector>

namespace skein {

/// What lies in a run folder beside a trajectory of so many segments: segments behind its end, also damaged ones, and
/// files that a killed process left half-written. Only names that runs give are looked for: notes of others stay.
/// @throws Error(io_error) if a folder cannot be listed
std::vector<std::filesystem::path> find_leftovers(const RunFolder& folder, std::int64_t n_segments);

/// Removes all of them, or none where a folder cannot be listed.
/// @throws Error(io_error), naming the file: a later file of that name could not be written either
void remove_leftovers(const RunFolder& folder, std::int64_t n_segments);

/// Whether there is a segment, whole or not. @throws Error(io_error)
bool holds_segments(const RunFolder& folder);

}  // namespace skein
