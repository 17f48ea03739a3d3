#pragma once

#include <skein/io/run_lock.hpp>
#include <skein/scene/sweep_file.hpp>

#include "studies/side_by_side.hpp"

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace skein {

/// Where each file of a sweep lies. Its folder holds copies of all that the runs are made of, so that it needs nothing
/// else to go on.
struct SweepFolder {
  std::filesystem::path path;

  std::filesystem::path sweep() const { return path / "sweep.toml"; }
  std::filesystem::path base_scene() const { return path / "base.toml"; }
  std::filesystem::path runs() const { return path / "runs"; }
  std::filesystem::path results() const { return path / "results"; }
  std::filesystem::path pictures() const { return path / "pictures"; }
  std::filesystem::path table() const { return path / "table.csv"; }
  std::filesystem::path numbers() const { return path / "table.h5"; }
  std::filesystem::path fibers() const { return path / "fibers.csv"; }
  std::filesystem::path failures() const { return path / "failures.csv"; }
  std::filesystem::path slurm_script() const { return path / "sweep.sbatch"; }
  std::filesystem::path stop_request() const { return path / "STOP"; }
  std::filesystem::path lock() const { return path / "lock"; }
};

/// A part of a sweep's runs, of which every n-th belongs to it.
struct Shard {
  std::size_t number = 1, n_shards = 1;  ///< from 1

  bool is_whole() const { return n_shards == 1; }
  bool has(const std::size_t run) const { return run % n_shards == number - 1; }
};

/// "3/8". @throws Error(usage)
Shard read_shard(const std::string& text);

/// A sweep with its folder.
struct Sweep {
  SweepFolder folder;
  SweepConfig config;
  RunList runs;
};

/// Makes the folder of a sweep, or finds the sweep in it again. Nothing is written before each of its scenes was found
/// good.
/// @param file  empty: the folder's own, which must be there
/// @throws SceneError for what is wrong in the file or in a scene, at their places; Error(cannot_create) where the
/// folder
///         holds another sweep or anything else
Sweep open_sweep(const std::filesystem::path& file, const std::filesystem::path& folder);

/// The scenes of a sweep that is only looked at. @throws as open_sweep
SweepConfig check_sweep(const std::filesystem::path& file);

/// Keeps a second process from the same shard, and from the tables.
/// @throws Error(cannot_create) naming the one that has it
std::unique_ptr<RunLock> lock_sweep(const SweepFolder& folder, const Shard& shard);

/// What is known of each run; of those that failed only what would fail again.
std::vector<std::optional<RunResult>> read_results(const RunList& runs);

}  // namespace skein
