#include "toml_file.hpp"

#include <skein/scene/scene_file.hpp>

#include <fmt/format.h>

#include <cerrno>
#include <cstring>
#include <fstream>
#include <system_error>

namespace skein {
namespace {

[[noreturn]] void throw_single(const SceneSource& source, const TomlFileKind& kind, const Place& place,
                               const std::string& message) {
  throw SceneError(source.name(), {Problem{source.locate(place), message, ""}}, kind.name);
}

void check_is_text(const std::string& text, const SceneSource& source, const TomlFileKind& kind) {
  if (text.find_first_not_of(" \t\r\n") == std::string::npos)
    throw_single(source, kind, {1, 1}, fmt::format("the file is empty; {}", kind.where_to_begin));
  if (text.find('\0') != std::string::npos)
    throw_single(source, kind, {1, 1}, fmt::format("this is a binary file; a {} is a text in TOML", kind.name));
}

}  // namespace

std::string read_toml_file(const std::filesystem::path& file, const TomlFileKind& kind) {
  std::error_code error;
  const auto status = std::filesystem::status(file, error);
  if (!std::filesystem::exists(status))
    throw Error(ExitCode::missing_input, fmt::format("the {} {} is not there", kind.name, file.string()));
  if (std::filesystem::is_directory(status))
    throw Error(ExitCode::missing_input, fmt::format("{} is a folder; name a {} file", file.string(), kind.name));
  std::ifstream stream(file, std::ios::binary);
  // Piece by piece: its size may be unknown, as that of a pipe is, and more than allowed need not be read.
  constexpr std::size_t piece = std::size_t{1} << 16;
  std::string text;
  while (stream && text.size() <= largest_scene) {
    const std::size_t n_before = text.size();
    text.resize(n_before + piece);
    stream.read(text.data() + n_before, piece);
    text.resize(n_before + static_cast<std::size_t>(stream.gcount()));
  }
  if (stream.bad() || (stream.fail() && !stream.eof()))
    throw Error(ExitCode::missing_input,
                fmt::format("the {} {} cannot be read: {}", kind.name, file.string(), std::strerror(errno)));
  if (text.size() > largest_scene)
    throw_single({file.string(), {}}, kind, {1, 1},
                 fmt::format("the file is larger than {} MiB, which no {} is", largest_scene >> 20, kind.name));
  return text;
}

SceneValue parse_toml_file(const std::string& text, const SceneSource& source, const TomlFileKind& kind) {
  check_is_text(text, source, kind);
  try {
    return parse_toml(text, kind.limits);
  } catch (const SyntaxError& error) {
    throw_single(source, kind, error.place, "not valid TOML: " + error.message);
  }
}

}  // namespace skein
