#pragma once

#include <skein/core/error.hpp>

#include "runs/run_measures.hpp"

#include <filesystem>
#include <optional>
#include <string>

namespace skein {

/// How one run of many came out.
struct RunResult {
  ExitCode code = ExitCode::done;
  std::string message;   ///< of a failure
  RunMeasures measures;  ///< empty after a failure
};

/// Whether the same run would fail again: what the scene or the program decides, not the machine.
bool fails_always(ExitCode code);

/// A file for each run, whole or not there, so that what is known survives a kill of any process.
/// @throws Error(io_error)
void write_run_result(const std::filesystem::path& file, const RunResult& result);

/// Nothing where there is no file, or one that is damaged or of a version that measured other things: the run is then
/// looked at again.
std::optional<RunResult> read_run_result(const std::filesystem::path& file);

}  // namespace skein
