#pragma once

#include "studies/sweep.hpp"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace skein {

/// The tables of a sweep: table.csv and table.h5 with a row for each run, the keys that differ, then what was measured;
/// fibers.csv with a row for each fiber where runs have several; failures.csv with the runs that failed and why. They
/// follow from the results alone, in the order of the runs. Each is whole or not there. @throws Error(io_error)
void write_sweep_tables(const Sweep& sweep, const std::vector<std::optional<RunResult>>& results);

/// Names of the table's columns that pictures can show: parameters, then what is measured.
std::vector<std::string> list_sweep_columns(const SweepConfig& sweep);

/// @throws Error(usage), or for a picture of the sweep's file SceneError, where a picture shows what is no column
void check_sweep_pictures(const std::filesystem::path& file, const SweepConfig& sweep);
void check_sweep_picture(const SweepConfig& sweep, const SweepPicture& picture);

/// What a sweep is drawn as where nobody says: regime, half period and curvature over its first parameter, or regime
/// and curvature over its first two that are crossed.
std::vector<SweepPicture> choose_sweep_pictures(const SweepConfig& sweep);

/// As `read_sweep_picture` reads it.
std::string describe_sweep_picture(const SweepPicture& picture);

}  // namespace skein
