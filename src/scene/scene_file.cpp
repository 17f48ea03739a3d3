#include <skein/scene/scene_file.hpp>

#include "overrides.hpp"
#include "repeatable_tables.hpp"
#include "scene_checks.hpp"
#include "scene_keys.hpp"
#include "scene_reader.hpp"
#include "toml_file.hpp"

#include <fmt/format.h>

#include <utility>

namespace skein {

SceneReading read_scene_text(const std::string& text, const std::string& name,
                             const std::vector<std::string>& overrides, const SceneCheck& check) {
  const SceneSource source(name, overrides);
  SceneValue root = parse_toml_file(text, source, scene_file);
  std::vector<Problem> problems;
  apply_overrides(root, source, problems);

  SceneReading reading;
  SceneReader reader(root, source);
  for (const RepeatableTable& table : repeatable_tables()) table.resize(reading.config, reader.n_instances(table.name));
  visit_keys(reader, reading.config);
  problems.insert(problems.end(), reader.problems().begin(), reader.problems().end());
  check_scene(reading.config, reader, problems, reading.warnings);
  if (check && problems.empty())
    for (const KeyProblem& found : check(reading.config)) reader.add(problems, found.key, found.message);

  sort_problems(problems);
  sort_problems(reading.warnings);
  if (!problems.empty()) throw SceneError(name, std::move(problems));
  return reading;
}

std::string read_scene_bytes(const std::filesystem::path& file) { return read_toml_file(file, scene_file); }

SceneReading read_scene(const std::filesystem::path& file, const std::vector<std::string>& overrides,
                        const SceneCheck& check) {
  return read_scene_text(read_scene_bytes(file), file.string(), overrides, check);
}

std::string write_readable_scene(const SceneConfig& scene) {
  std::string text = write_scene(scene);
  if (text.size() > largest_scene)
    throw Error(
        ExitCode::scene_error,
        fmt::format("with every key of its {} fibers the scene has {:.1f} MiB, and no more than {} MiB are read "
                    "again from a run folder: use fewer fibers, or fewer pairs in stiffness_profile",
                    scene.fibers.size(), static_cast<double>(text.size()) / (1 << 20), largest_scene >> 20));
  SceneConfig expected = scene;
  if (expected.flows.empty()) expected.flows.push_back({.kind = FlowKind::none});  // as it is written
  SceneConfig found;
  try {
    found = read_scene_text(text, "the resolved scene", {}).config;
  } catch (const SceneError& error) {
    throw Error(
        ExitCode::scene_error,
        fmt::format("a run of this scene could not be resumed, since the scene with every key would be refused: "
                    "{}",
                    error.what()));
  }
  if (!(found == expected))
    throw Error(ExitCode::scene_error,
                "a run of this scene could not be resumed: with every key written it is read as another one. Look for "
                "unusual characters in its title, and please report it");
  return text;
}

}  // namespace skein
