#include <skein/scene/scene_file.hpp>

#include "overrides.hpp"
#include "repeatable_tables.hpp"
#include "scene_checks.hpp"
#include "scene_keys.hpp"
#include "scene_reader.hpp"
#include "toml_parser.hpp"

#include <fmt/format.h>

#include <cerrno>
#include <cstring>
#include <fstream>
#include <system_error>
#include <utility>

namespace skein {
namespace {

[[noreturn]] void throw_single(const SceneSource& source, const Place& place, const std::string& message) {
  throw SceneError(source.name(), {Problem{source.locate(place), message, ""}});
}

void check_is_text(const std::string& text, const SceneSource& source) {
  if (text.find_first_not_of(" \t\r\n") == std::string::npos) {
    throw_single(source, {1, 1}, "the file is empty; 'skein defaults' prints a scene to start from");
  }
  if (text.find('\0') != std::string::npos) {
    throw_single(source, {1, 1}, "this is a binary file; a scene is a text in TOML");
  }
}

SceneValue parse_scene(const std::string& text, const SceneSource& source) {
  check_is_text(text, source);
  try {
    return parse_toml(text);
  } catch (const SyntaxError& error) {
    throw_single(source, error.place, "not valid TOML: " + error.message);
  }
}

}  // namespace

SceneReading read_scene_text(const std::string& text, const std::string& name,
                             const std::vector<std::string>& overrides, const SceneCheck& check) {
  const SceneSource source(name, overrides);
  SceneValue root = parse_scene(text, source);
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

SceneReading read_scene(const std::filesystem::path& file, const std::vector<std::string>& overrides,
                        const SceneCheck& check) {
  std::error_code error;
  const auto status = std::filesystem::status(file, error);
  if (!std::filesystem::exists(status)) {
    throw Error(ExitCode::missing_input, fmt::format("the scene {} is not there", file.string()));
  }
  if (std::filesystem::is_directory(status)) {
    throw Error(ExitCode::missing_input, fmt::format("{} is a folder; name a scene file", file.string()));
  }
  std::ifstream stream(file, std::ios::binary);
  // One byte more than allowed tells a file that is too large; its size may be unknown, as that of a pipe is.
  std::string text(largest_scene + 1, '\0');
  stream.read(text.data(), static_cast<std::streamsize>(text.size()));
  if (!stream.eof() && !stream.good()) {
    throw Error(ExitCode::missing_input,
                fmt::format("the scene {} cannot be read: {}", file.string(), std::strerror(errno)));
  }
  text.resize(static_cast<std::size_t>(stream.gcount()));
  if (text.size() > largest_scene) {
    throw_single({file.string(), {}}, {1, 1},
                 fmt::format("the file is larger than {} MiB, which no scene is", largest_scene >> 20));
  }
  return read_scene_text(text, file.string(), overrides, check);
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
