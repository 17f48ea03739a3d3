#include <skein/core/error.hpp>
#include <skein/io/atomic_file.hpp>
#include <skein/io/run_folder.hpp>

#include <fmt/format.h>

#include <array>
#include <cctype>
#include <string_view>
#include <system_error>

namespace skein {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view partial_suffix = ".partial";

std::string_view without_partial(std::string_view name) {
  if (name.ends_with(partial_suffix)) name.remove_suffix(partial_suffix.size());
  return name;
}

bool is_file_of_a_run(const std::string& name) {
  constexpr std::array<std::string_view, 7> names = {"scene.toml",   "trajectory.h5", "trajectory.xdmf", "run.log",
                                                     "events.jsonl", "STOP",          "OUTPUT_NOW"};
  for (const std::string_view known : names)
    if (without_partial(name) == known) return true;
  return false;
}

// Segments and checkpoints: digits and ".h5" or ".checkpoint", also what became of them.
bool is_numbered_file(const std::string& name) {
  std::string_view stem = without_partial(name);
  for (const std::string_view suffix : {".damaged", ".checkpoint", ".h5"})
    if (stem.ends_with(suffix)) stem.remove_suffix(suffix.size());
  if (stem.size() == name.size()) return false;
  for (const char c : stem)
    if (std::isdigit(static_cast<unsigned char>(c)) == 0) return false;
  return !stem.empty();
}

// A scene.toml alone may be somebody's own: the folder of segments tells a run, from its first moment on.
bool holds_a_run(const RunFolder& folder) {
  if (!fs::is_directory(folder.segments())) return false;
  const bool has_nothing_else = std::distance(fs::directory_iterator(folder.path()), fs::directory_iterator()) == 1;
  return fs::exists(folder.scene()) || has_nothing_else;
}

void check_present(const fs::path& folder, const fs::path& file) {
  std::error_code ignored;
  if (!fs::exists(file, ignored))
    throw Error(ExitCode::missing_input,
                fmt::format("'{}' is not a run folder: it has no {}.", folder.string(), file.filename().string()));
}

void remove_files(const fs::path& folder, bool (*is_ours)(const std::string&)) {
  if (!fs::is_directory(folder)) return;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder))
    if (!entry.is_directory() && is_ours(entry.path().filename().string())) fs::remove(entry.path());
}

}  // namespace

RunFolder RunFolder::create(const fs::path& path, const std::string& scene, const bool overwrite) {
  RunFolder folder(path);
  const std::string name = path.string();
  try {
    if (fs::exists(path) && (!fs::is_directory(path) || !fs::is_empty(path))) {
      if (!fs::is_directory(path) || !holds_a_run(folder))
        throw Error(ExitCode::cannot_create,
                    fmt::format("'{}' exists and is not a run folder; name another output folder.", name));
      if (!overwrite)
        throw Error(
            ExitCode::cannot_create,
            fmt::format("'{}' holds a run already; resume it, name another output folder, or give --overwrite.", name));
      // The index goes first, so that a reader never follows it to segments that are gone.
      fs::remove(folder.index());
      remove_files(folder.segments(), is_numbered_file);
      remove_files(folder.checkpoints(), is_numbered_file);
      remove_files(path, is_file_of_a_run);
    }
    // Of two that start at once in a new folder only one makes this folder.
    if (!fs::create_directories(folder.segments()) && !overwrite)
      throw Error(ExitCode::cannot_create, fmt::format("another run has just begun in '{}'.", name));
  } catch (const fs::filesystem_error& error) {
    const bool disk = error.code() == std::errc::no_space_on_device || error.code() == std::errc::io_error;
    throw Error(disk ? ExitCode::io_error : ExitCode::cannot_create,
                fmt::format("cannot create the run folder '{}': {}.", name, error.code().message()));
  }
  write_file_atomically(folder.scene(), scene);
  return folder;
}

RunFolder RunFolder::open_begun(const fs::path& path) {
  RunFolder folder(path);
  std::error_code ignored;
  if (!fs::is_directory(path, ignored))
    throw Error(ExitCode::missing_input, fmt::format("there is no run folder '{}'.", path.string()));
  check_present(path, folder.scene());
  return folder;
}

RunFolder RunFolder::open(const fs::path& path) {
  RunFolder folder = open_begun(path);
  check_present(path, folder.index());
  return folder;
}

}  // namespace skein
