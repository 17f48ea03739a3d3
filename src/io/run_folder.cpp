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

// What `skein analyze` and `skein plot` write.
bool is_table(const std::string& name) {
  const std::string_view whole = without_partial(name);
  return whole == "diagnostics.h5" || whole == "diagnostics.csv";
}

bool is_picture(const std::string& name) {
  constexpr std::array<std::string_view, 7> pictures = {"shapes",  "angle", "curvature", "energy",
                                                        "extrema", "power", "defects"};
  const std::string_view whole = without_partial(name);
  for (const std::string_view suffix : {".png", ".pdf", ".svg"})
    for (const std::string_view picture : pictures)
      if (whole.ends_with(suffix) && whole.substr(0, whole.size() - suffix.size()) == picture) return true;
  return whole == "movie.mp4";
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

// A folder of results goes with the last of them; what somebody else put there stays.
void remove_results(const fs::path& folder, bool (*is_ours)(const std::string&)) {
  if (!fs::is_directory(fs::symlink_status(folder))) return;
  remove_files(folder, is_ours);
  if (fs::is_empty(folder)) fs::remove(folder);
}

// The way from a folder down to a path whose links are resolved; empty if it is not below. Folders are compared as the
// system knows them, whatever they are called: by another mount, or in other letters.
fs::path find_way_below(const fs::path& folder, const fs::path& path) {
  std::error_code ignored;
  fs::path way;
  for (fs::path place = path; place.has_relative_path();) {
    way = way.empty() ? place.filename() : place.filename() / way;
    place = place.parent_path();
    if (fs::equivalent(place, folder, ignored)) return way;
  }
  return {};
}

bool is_way_to_part(const fs::path& way) {
  if (way.empty()) return false;
  const std::string first = way.begin()->string();
  return first == "lock" || first == "segments" || first == "checkpoints" || is_file_of_a_run(first);
}

}  // namespace

RunFolder RunFolder::create(const fs::path& path, const std::string& scene, const bool overwrite) {
  if (path.empty()) throw Error(ExitCode::usage, "the run folder has no name");
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
      remove_results(folder.analysis(), is_table);
      remove_results(folder.plots(), is_picture);
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

bool RunFolder::is_part(const fs::path& path) const {
  std::error_code ignored;
  const fs::path whole = fs::absolute(path.has_filename() ? path : path.parent_path());
  // A file that is written takes the place of a link; a file that is read, or a folder, is where the link leads to.
  const fs::path place = fs::weakly_canonical(whole.parent_path(), ignored) / whole.filename();
  return is_way_to_part(find_way_below(path_, place)) ||
         is_way_to_part(find_way_below(path_, fs::weakly_canonical(whole, ignored)));
}

void check_output(const fs::path& output, const RunFolder& run) {
  if (!run.is_part(output)) return;
  throw Error(ExitCode::cannot_create,
              fmt::format("'{}' is a part of the run in '{}' and is not replaced; name another output.",
                          output.string(), run.path().string()));
}

}  // namespace skein
