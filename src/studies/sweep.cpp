#include "studies/sweep.hpp"

#include <skein/core/error.hpp>
#include <skein/io/atomic_file.hpp>
#include <skein/io/folder_listing.hpp>
#include <skein/io/read_file.hpp>
#include <skein/io/start_file.hpp>
#include <skein/io/start_name.hpp>
#include <skein/scene/scene_file.hpp>

#include "runs/memory_limit.hpp"
#include "studies/sweep_scenes.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <chrono>
#include <system_error>
#include <thread>
#include <utility>

namespace skein {
namespace {

namespace fs = std::filesystem;

bool is_file(const fs::path& path) { return fs::is_regular_file(fs::symlink_status(path)); }

// A sweep.toml alone may be somebody's own: the folder of results tells a sweep.
bool holds_sweep(const SweepFolder& folder) { return is_file(folder.sweep()) && fs::is_directory(folder.results()); }

// What a process leaves that is killed before the sweep is there.
bool is_only_begun(const SweepFolder& folder) {
  bool has_results = false;
  for (const std::string& name : list_names(folder.path)) {
    const fs::path path = folder.path / name;
    if (path == folder.results() && fs::is_directory(fs::symlink_status(path)) && list_names(path).empty())
      has_results = true;
    else if (!is_file(path) || (path != folder.lock() && path != folder.base_scene() && !name.ends_with(".partial") &&
                                !is_start_name(name)))
      return false;
  }
  return has_results;
}

void check_may_be_used(const SweepFolder& folder) {
  if (!is_there(folder.path)) return;
  if (fs::is_directory(folder.path) &&
      (holds_sweep(folder) || list_names(folder.path).empty() || is_only_begun(folder)))
    return;
  throw Error(ExitCode::cannot_create,
              fmt::format("'{}' exists and is no sweep's folder; name another output folder.", folder.path.string()));
}

void check_is_same(const SweepFolder& folder, const SweepTexts& texts) {
  const auto compare = [&](const fs::path& file, const std::string& text, const char* what) {
    if ((is_there(file) ? read_file(file) : "") != text)
      throw Error(
          ExitCode::cannot_create,
          fmt::format("'{}' holds a sweep {}: go on with that one by 'skein sweep -o {}', or name another folder.",
                      folder.path.string(), what, folder.path.string()));
  };
  compare(folder.sweep(), texts.sweep, "of another file");
  compare(folder.base_scene(), texts.base_scene, "of another scene");
}

/// Of several that begin at once, as the tasks of a batch job may, one makes the folder and the others find it.
std::unique_ptr<RunLock> wait_for_lock(const fs::path& file) {
  using namespace std::chrono_literals;
  constexpr int patience = 100;
  for (int attempt = 0;; ++attempt) {
    try {
      return std::make_unique<RunLock>(file);
    } catch (const Error& error) {
      if (error.code() != ExitCode::cannot_create || attempt >= patience) throw;
    }
    std::this_thread::sleep_for(100ms);
  }
}

void fill_folder(const SweepFolder& folder, const SweepTexts& texts) {
  const auto lock = wait_for_lock(folder.lock());
  if (holds_sweep(folder)) return check_is_same(folder, texts);
  if (!texts.start.empty()) write_file_atomically(find_start(folder.path, checksum_of_start(texts.start)), texts.start);
  write_file_atomically(folder.base_scene(), texts.base_scene);
  write_file_atomically(folder.sweep(), texts.sweep);  // with it the folder is a sweep's
}

void make_folder(const SweepFolder& folder, const fs::path& file, const SweepConfig& config) {
  if (!holds_sweep(folder)) check_sweep_scenes(file, config);
  const SweepTexts texts = read_sweep_texts(file, config);
  if (holds_sweep(folder)) return check_is_same(folder, texts);
  try {
    fs::create_directories(folder.results());
  } catch (const fs::filesystem_error& error) {
    throw Error(ExitCode::cannot_create, fmt::format("cannot create the sweep's folder '{}': {}.", folder.path.string(),
                                                     error.code().message()));
  }
  fill_folder(folder, texts);
}

RunList list_runs(const SweepFolder& folder, const SweepConfig& config) {
  RunList list;
  list.runs = folder.runs();
  list.results = folder.results();
  const std::string base = read_file(folder.base_scene());
  for (std::size_t run = 0; run < count_sweep_runs(config); ++run) {
    const SceneConfig scene =
        read_scene_text(base, folder.base_scene().string(), make_sweep_overrides(config, run)).config;
    list.names.push_back(name_sweep_run(run));
    add_estimates(list, scene);
  }
  list.make = [file = folder.base_scene(), config](const std::size_t run) {
    return make_new_run(file, make_sweep_overrides(config, run));
  };
  return list;
}

}  // namespace

Shard read_shard(const std::string& text) {
  Shard shard;
  const char *first = text.data(), *last = first + text.size();
  const auto number = std::from_chars(first, last, shard.number);
  const bool has_slash = number.ec == std::errc() && number.ptr != last && *number.ptr == '/';
  const auto count = has_slash ? std::from_chars(number.ptr + 1, last, shard.n_shards) : number;
  if (!has_slash || count.ec != std::errc() || count.ptr != last || shard.number < 1 || shard.number > shard.n_shards)
    throw Error(ExitCode::usage, fmt::format("--shard {}: write I/N with I from 1 to N, such as 3/8", text));
  return shard;
}

Sweep open_sweep(const fs::path& file, const fs::path& path) {
  if (path.empty()) throw Error(ExitCode::usage, "the sweep's folder has no name");
  const SweepFolder folder{path};
  if (file.empty()) {
    if (!is_there(path) || !holds_sweep(folder))
      throw Error(ExitCode::missing_input,
                  fmt::format("'{}' holds no sweep: name its file, as in 'skein sweep SWEEP.toml -o {}'.",
                              path.string(), path.string()));
  } else {
    check_may_be_used(folder);
    make_folder(folder, file, read_sweep(file));
  }
  SweepConfig config = read_sweep(folder.sweep());
  config.scene = folder.base_scene();
  RunList runs = list_runs(folder, config);
  return {folder, std::move(config), std::move(runs)};
}

SweepConfig check_sweep(const fs::path& file) {
  SweepConfig config = read_sweep(file);
  check_sweep_scenes(file, config);
  return config;
}

std::unique_ptr<RunLock> lock_sweep(const SweepFolder& folder, const Shard& shard) {
  return std::make_unique<RunLock>(
      shard.is_whole() ? folder.lock()
                       : folder.path / fmt::format("shard_{}_of_{}.lock", shard.number, shard.n_shards));
}

std::vector<std::optional<RunResult>> read_results(const RunList& runs) {
  std::vector<std::optional<RunResult>> results;
  for (std::size_t i = 0; i < runs.names.size(); ++i) results.push_back(read_run_result(runs.result(i)));
  return results;
}

}  // namespace skein
