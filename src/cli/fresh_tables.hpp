#pragma once

#include <filesystem>
#include <optional>
#include <string>

namespace skein {

/// Several pictures are of what `skein analyze` measures: the folder of a run's tables that are up to date. Where its
/// own are older than the run it is analyzed. Energies and powers take an evaluation of the fluid for each frame, which
/// large runs are asked for only by the verb itself. Needs Kokkos.
/// @param elsewhere  where tables are written then; empty: into the run's own folder
/// @returns nothing where they cannot be made, and says why: other pictures may be possible still
std::optional<std::filesystem::path> refresh_tables(const std::filesystem::path& run,
                                                    const std::filesystem::path& elsewhere);

/// Analyzes a run, whether or not its tables are up to date. Needs Kokkos. @param tables  where they are written
/// @returns the summary for people
std::string write_fresh_tables(const std::filesystem::path& run, const std::filesystem::path& tables);

}  // namespace skein
