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

constexpr std::size_t n_bytes_allowed = 16 * 1024 * 1024;

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
  std::string text(n_bytes_allowed + 1, '\0');
  stream.read(text.data(), static_cast<std::streamsize>(text.size()));
  if (!stream.eof() && !stream.good()) {
    throw Error(ExitCode::missing_input,
                fmt::format("the scene {} cannot be read: {}", file.string(), std::strerror(errno)));
  }
  text.resize(static_cast<std::size_t>(stream.gcount()));
  if (text.size() > n_bytes_allowed) {
    throw_single({file.string(), {}}, {1, 1}, "the file is larger than 16 MiB, which no scene is");
  }
  return read_scene_text(text, file.string(), overrides, check);
}

}  // namespace skein
