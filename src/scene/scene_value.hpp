#pragma once

#include <skein/scene/scene_problem.hpp>

#include <cstdint>
#include <string>
#include <vector>

namespace skein {

/// A place in the file (line, column) or in a --set (override_index); the name of the source is added in a Problem.
struct Place {
  int line = 0, column = 0;
  int override_index = -1;
};

/// A value of a scene with its place: a tree apart from the parser's types, so that one source file includes the parser
/// and overrides can be put in.
struct SceneValue {
  enum class Kind { table, list, text, integer, number, boolean, moment };

  Kind kind = Kind::table;
  Place place;
  std::string name;  ///< the key, where the value stands in a table
  Place name_place;

  std::string text;
  std::int64_t integer = 0;
  double number = 0.0;
  bool boolean = false;
  std::vector<SceneValue> children;  ///< of a table or list. Only the first of a list that does not hold tables
  std::size_t n_children = 0;

  const SceneValue* find(const std::string& key) const;
  SceneValue* find(const std::string& key);
  bool is_list_of_tables() const;
};

/// NaN for what is none.
double to_number(const SceneValue& value);

/// TOML of a number, an integer, text, true or false, or a list of these.
std::string format_value(const SceneValue& value);

/// As it would be written in the scene, cut to a readable length, without control characters.
std::string describe_value(const SceneValue& value);

/// "a number", "a table", ...
std::string describe_kind(SceneValue::Kind kind);

/// A name or text from a scene for a message: cut, without control characters.
std::string make_printable(const std::string& text);

/// The shortest TOML of a double that reads back to the same value, such as 12.0 or 1e-05.
std::string format_number(double number);

/// TOML's basic string.
std::string format_text(const std::string& text);

}  // namespace skein
