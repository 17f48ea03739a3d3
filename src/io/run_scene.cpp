#include <skein/core/error.hpp>
#include <skein/io/folder_listing.hpp>
#include <skein/io/read_file.hpp>
#include <skein/io/run_scene.hpp>
#include <skein/scene/earlier_ends.hpp>
#include <skein/scene/scene_file.hpp>

#include "scene_in_index.hpp"

#include <fmt/format.h>

#include <optional>

namespace skein {

SceneConfig read_run_scene(const RunFolder& folder) {
  SceneConfig scene = read_scene_text(read_file(folder.scene()), folder.scene().string(), {}).config;
  for (const FiberConfig& fiber : scene.fibers)
    if (fiber.stands_for_tube())
      throw Error(ExitCode::damaged_data,
                  fmt::format("'{}' has a fiber that stands for a tube; runs write numbers in its stead: the file was "
                              "changed since. Put it back.",
                              folder.scene().string()));
  return scene;
}

void check_scene_is_of_run(const RunFolder& folder) {
  if (!is_there(folder.index())) return;
  std::optional<Hdf5Reader> index;
  try {
    index.emplace(folder.index());
  } catch (const Error&) {  // whoever needs the index tells what is wrong with it
    return;
  }
  compare_with_scene_in_index(folder, *index);
}

void compare_with_scene_in_index(const RunFolder& folder, const Hdf5Reader& index) {
  if (!index.has_attribute("/parameters", "scene")) return;
  // A run whose end was moved, and that was killed then, has the index of before.
  if (!is_prolonged_from(read_file(folder.scene()), index.text_attribute("/parameters", "scene")))
    throw Error(
        ExitCode::damaged_data,
        fmt::format("'{0}' is not the scene that this run was computed with: it was changed since. Put it back, "
                    "or compute the changed scene in another folder: 'skein run {0} -o DIR'. The text of then "
                    "is the attribute 'scene' of /parameters in '{1}'.",
                    folder.scene().string(), folder.index().string()));
}

}  // namespace skein
