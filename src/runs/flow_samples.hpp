#pragma once

#include <skein/io/run_folder.hpp>

#include <filesystem>

namespace skein {

/// Writes what the background flow does around a run's fibers, for pictures: a table with the columns time, x, y, z, u,
/// v, w. Points are a grid over the box of some frames' centrelines, with a margin; a steady flow has one time, another
/// 60 of the run's. Needs Kokkos.
/// @returns false, with nothing written, where there is no flow
/// @throws as TrajectoryReader; Error(io_error)
bool write_flow_samples(const RunFolder& folder, const std::filesystem::path& table);

}  // namespace skein
