#include <skein/core/error.hpp>
#include <skein/io/atomic_file.hpp>
#include <skein/io/checkpoint.hpp>
#include <skein/io/folder_listing.hpp>
#include <skein/io/read_file.hpp>
#include <skein/io/run_folder.hpp>
#include <skein/io/start_file.hpp>
#include <skein/io/start_name.hpp>

#include "run_file_names.hpp"

#include <fmt/format.h>

#include <string>
#include <system_error>
#include <vector>

namespace skein {
namespace {

namespace fs = std::filesystem;

enum class Content { nothing, remains, run, other };

bool is_file(const fs::path& path) { return fs::is_regular_file(fs::symlink_status(path)); }

// Half of a scene that this program was writing begins with the scene's first key, as far as it goes.
bool begins_as(const std::string& scene, const fs::path& half) {
  const std::string key = scene.substr(0, scene.find('=') + 1), text = read_file(half);
  return text.substr(0, key.size()) == key.substr(0, text.size());
}

// The state of another run, or half of it.
bool begins_as_checkpoint(const fs::path& file) {
  const std::string magic(checkpoint_magic), text = read_file(file);
  return text.substr(0, magic.size()) == magic.substr(0, text.size());
}

bool is_beginning(const RunFolder& folder, const std::string& name, const std::string& scene) {
  const fs::path path = folder.path() / name;
  if (!is_file(path)) return false;
  if (name == "scene.toml.partial") return begins_as(scene, path);
  if (is_start_name(name)) return begins_as_checkpoint(path);
  return path == folder.lock();
}

// What a run leaves that is killed before its scene is there. Whatever else lies there is somebody's.
bool is_only_begun(const RunFolder& folder, const std::vector<std::string>& names, const std::string& scene) {
  bool has_segments = false;
  for (const std::string& name : names) {
    const fs::path path = folder.path() / name;
    if (path == folder.segments() && fs::is_directory(fs::symlink_status(path)) && list_names(path).empty())
      has_segments = true;
    else if (!is_beginning(folder, name, scene))
      return false;
  }
  return has_segments;
}

Content look_into(const RunFolder& folder, const std::string& scene) {
  if (!is_there(folder.path())) return Content::nothing;
  if (!fs::is_directory(folder.path())) return Content::other;
  const auto names = list_names(folder.path());
  if (names.empty()) return Content::nothing;
  if (is_only_begun(folder, names, scene)) return Content::remains;
  // A scene.toml alone may be somebody's own: the folder of segments tells a run.
  return fs::is_directory(folder.segments()) && is_there(folder.scene()) ? Content::run : Content::other;
}

void check_may_be_used(const fs::path& path, const Content content, const bool overwrite) {
  if (content == Content::other)
    throw Error(ExitCode::cannot_create,
                fmt::format("'{}' exists and is not a run folder; name another output folder.", path.string()));
  if (content == Content::run && !overwrite)
    throw Error(ExitCode::cannot_create, fmt::format("'{}' holds a run already; resume it, name another output folder, "
                                                     "or give --overwrite.",
                                                     path.string()));
}

void check_is_folder(const fs::path& path) {
  std::error_code error;
  const fs::file_status status = fs::status(path, error);
  if (status.type() == fs::file_type::none)
    throw Error(ExitCode::io_error, fmt::format("cannot look at '{}': {}.", path.string(), error.message()));
  if (status.type() != fs::file_type::directory)
    throw Error(ExitCode::missing_input, fmt::format("there is no run folder '{}'.", path.string()));
}

// Another folder that a link leads to is not this run's.
bool is_own_folder(const fs::path& folder) { return fs::is_directory(fs::symlink_status(folder)); }

void add_files(std::vector<fs::path>& files, const fs::path& folder, bool (*is_ours)(const std::string&)) {
  for (const std::string& name : list_names(folder))
    if (is_ours(name) && !fs::is_directory(folder / name)) files.push_back(folder / name);
}

// In the order in which they go: the index first, so that a reader never follows it to segments that are gone.
std::vector<fs::path> list_files_of_run(const RunFolder& folder) {
  std::vector<fs::path> files{folder.index()};
  add_files(files, folder.segments(), is_numbered_file);
  add_files(files, folder.checkpoints(), is_numbered_file);
  if (is_own_folder(folder.analysis())) add_files(files, folder.analysis(), is_table);
  if (is_own_folder(folder.plots())) add_files(files, folder.plots(), is_picture);
  add_files(files, folder.path(),
            [](const std::string& name) { return is_file_of_a_run(name) && name != "scene.toml"; });
  return files;
}

// A folder of results goes with the last of them; what somebody else put there stays.
void remove_if_empty(const fs::path& folder) {
  if (is_own_folder(folder) && fs::is_empty(folder)) fs::remove(folder);
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

RunFolder RunFolder::create(const fs::path& path, const std::string& scene, const bool overwrite, const Use& use,
                            const std::string& start) {
  if (path.empty()) throw Error(ExitCode::usage, "the run folder has no name");
  RunFolder folder(path);
  const std::string name = path.string();
  try {
    const Content content = look_into(folder, scene);
    check_may_be_used(path, content, overwrite);
    // Of two that start at once in a new folder only one makes this folder.
    if (!fs::create_directories(folder.segments()) && content == Content::nothing)
      throw Error(ExitCode::cannot_create, fmt::format("another run has just begun in '{}'.", name));
    if (use) use(folder);
    auto earlier = content == Content::nothing ? std::vector<fs::path>{} : list_files_of_run(folder);
    if (!start.empty()) {  // before the scene that names it, and beside the one that an earlier scene names
      const fs::path file = find_start(path, checksum_of_start(start));
      std::erase(earlier, file);
      write_file_atomically(file, start);
    }
    // Once the new scene is there the rest is no run of it any more, whatever happens.
    write_file_atomically(folder.scene(), scene);
    for (const fs::path& file : earlier) fs::remove(file);
    if (content == Content::run)
      for (const fs::path& results : {folder.analysis(), folder.plots()}) remove_if_empty(results);
  } catch (const fs::filesystem_error& error) {
    const bool disk = error.code() == std::errc::no_space_on_device || error.code() == std::errc::io_error;
    throw Error(disk ? ExitCode::io_error : ExitCode::cannot_create,
                fmt::format("cannot create the run folder '{}': {}.", name, error.code().message()));
  }
  return folder;
}

RunFolder RunFolder::open_begun(const fs::path& path) {
  RunFolder folder(path);
  check_is_folder(path);
  if (!is_there(folder.scene()))
    throw Error(ExitCode::missing_input, fmt::format("'{}' is not a run folder: it has no scene.toml.", path.string()));
  return folder;
}

RunFolder RunFolder::open(const fs::path& path) {
  RunFolder folder = open_begun(path);
  if (!is_there(folder.index()))
    throw Error(
        ExitCode::missing_input,
        fmt::format("'{0}' has no trajectory.h5: the run wrote no frame yet, or has lost it; 'skein resume {0}' "
                    "writes it.",
                    path.string()));
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
