#pragma once

#include <skein/io/run_folder.hpp>

namespace skein {

/// Reads all segments that a run's index lists, for whoever draws them without looking at their checksums.
/// @throws Error(damaged_data) naming the file that was changed, is gone, or is of another run, scene.toml included;
///         Error(io_error) naming the one that cannot be read; Error(missing_input) if there is no run
void check_listed_segments(const RunFolder& folder);

}  // namespace skein
