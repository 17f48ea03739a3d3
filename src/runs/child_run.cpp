#include "runs/child_run.hpp"

#include <skein/core/error.hpp>
#include <skein/fibers/node_orbits.hpp>
#include <skein/io/read_file.hpp>
#include <skein/io/start_file.hpp>

#include "runs/parent_state.hpp"

#include <fmt/format.h>

#include <array>
#include <string_view>

namespace skein {
namespace {

[[noreturn]] void throw_scene_error(const std::filesystem::path& scene, const std::string& message) {
  throw SceneError(scene.string(), {Problem{{scene.string(), 0, 0, -1}, message, ""}});
}

// What the earlier run decides.
void check_overrides(const std::vector<std::string>& overrides) {
  for (const std::string& override : overrides)
    for (const std::string_view decided : {"time.start", "time.earlier_ends", "start."})
      if (override.starts_with(decided))
        throw Error(ExitCode::usage,
                    fmt::format("--set {}: with --from the start is that of the earlier run; RUN@TIME begins with one "
                                "of its frames",
                                override));
}

void check_same_fibers(const std::vector<FiberConfig>& fibers, const ParentState& parent,
                       const std::filesystem::path& scene) {
  const auto& before = parent.scene.fibers;
  if (fibers.size() != before.size())
    throw_scene_error(scene, fmt::format("the scene has {} fibers and the run '{}' {}: it cannot go on from there",
                                         fibers.size(), parent.name, before.size()));
  for (std::size_t i = 0; i < fibers.size(); ++i)
    if (fibers[i].sections != before[i].sections || fibers[i].nodes_per_section != before[i].nodes_per_section)
      throw_scene_error(
          scene, fmt::format("fiber {} has {} sections of {} nodes here, and {} of {} in the run '{}': it cannot go on "
                             "from there",
                             i, fibers[i].sections, fibers[i].nodes_per_section, before[i].sections,
                             before[i].nodes_per_section, parent.name));
}

/// Where the scene has a symmetry and the earlier run's state has not, the key is to be found in the file.
void check_symmetry(const SceneConfig& config, std::vector<Vec3> position, const std::string& parent,
                    const std::filesystem::path& scene, const std::vector<std::string>& changes) {
  if (config.symmetry.is_none()) return;
  const std::vector<Fiber> fibers = make_fibers(config.fibers);
  try {
    make_symmetric(make_node_orbits(config.symmetry, fibers, make_surface_nodes(fibers, config.seed)), fibers,
                   position);
  } catch (const Error& error) {
    if (error.code() != ExitCode::scene_error) throw;
    const std::string key = config.symmetry.mirror == SymmetryAxis::none ? "symmetry.half_turn" : "symmetry.mirror";
    const KeyProblem problem{key, fmt::format("the state of '{}' is not symmetric {}: {}; set symmetry.mirror and "
                                              "symmetry.half_turn to \"none\", or begin with an earlier frame",
                                              parent, describe_symmetry(config.symmetry), error.what())};
    read_scene(scene, changes, [&](const SceneConfig&) { return std::vector<KeyProblem>{problem}; });
  }
}

}  // namespace

NewRun make_new_run(const std::filesystem::path& scene, const std::vector<std::string>& overrides) {
  NewRun run{read_placed_scene(scene, overrides), "", ""};
  if (run.placed.config.start.checksum.empty()) return run;
  const std::filesystem::path start = find_start(scene.parent_path(), run.placed.config.start.checksum);
  run.start = read_file(start);
  decode_start(run.start, start, run.placed.config);
  return run;
}

NewRun make_child_run(const std::string& parent_name, const std::filesystem::path& scene,
                      const std::vector<std::string>& overrides) {
  check_overrides(overrides);
  const ParentState parent = read_parent_state(parent_name);
  const std::filesystem::path file = scene.empty() ? parent.folder.scene() : scene;
  std::vector<std::string> changes{fmt::format("time.start={}", parent.time), "time.earlier_ends=[]"};
  changes.insert(changes.end(), overrides.begin(), overrides.end());
  NewRun run{read_placed_scene(file, changes), encode_start(parent.position, parent.time), parent.what_happened,
             parent.name};
  SceneConfig& config = run.placed.config;
  check_same_fibers(config.fibers, parent, file);
  if (config.time.end <= parent.time)
    throw_scene_error(file,
                      fmt::format("the scene ends at t = {}, where the state of '{}' is already: give a later end, "
                                  "--set time.end=LATER",
                                  parent.time, parent.name));
  config.start = {checksum_of_start(run.start), parent.name, parent.certificate, parent.step};
  run.placed.text = write_readable_scene(config);
  // Whatever the checkpoint holds, the run can begin with it.
  const std::vector<Vec3> position = decode_start(run.start, find_start("", config.start.checksum), config);
  check_symmetry(config, position, parent.name, file, changes);
  return run;
}

}  // namespace skein
