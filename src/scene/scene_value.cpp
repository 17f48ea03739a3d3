#include "scene_value.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

namespace skein {
namespace {

constexpr std::size_t n_characters_shown = 60;

bool is_control(const char c) { return static_cast<unsigned char>(c) < 0x20 || c == 0x7f; }

}  // namespace

SceneValue* SceneValue::find(const std::string& key) {
  const auto found =
      std::find_if(children.begin(), children.end(), [&key](const auto& child) { return child.name == key; });
  return kind == Kind::table && found != children.end() ? &*found : nullptr;
}

const SceneValue* SceneValue::find(const std::string& key) const { return const_cast<SceneValue*>(this)->find(key); }

bool SceneValue::is_list_of_tables() const {
  return kind == Kind::list && !children.empty() &&
         std::all_of(children.begin(), children.end(), [](const auto& child) { return child.kind == Kind::table; });
}

double to_number(const SceneValue& value) {
  if (value.kind == SceneValue::Kind::integer) return static_cast<double>(value.integer);
  return value.kind == SceneValue::Kind::number ? value.number : std::numeric_limits<double>::quiet_NaN();
}

std::string format_value(const SceneValue& value) {
  if (value.kind == SceneValue::Kind::text) return format_text(value.text);
  if (value.kind != SceneValue::Kind::list) return describe_value(value);
  std::vector<std::string> parts;
  for (const SceneValue& child : value.children) parts.push_back(format_value(child));
  return fmt::format("[{}]", fmt::join(parts, ", "));
}

std::string describe_kind(const SceneValue::Kind kind) {
  switch (kind) {
    case SceneValue::Kind::table:
      return "a table";
    case SceneValue::Kind::list:
      return "a list";
    case SceneValue::Kind::text:
      return "text";
    case SceneValue::Kind::integer:
      return "an integer";
    case SceneValue::Kind::number:
      return "a number";
    case SceneValue::Kind::boolean:
      return "true or false";
    case SceneValue::Kind::moment:
      return "a date or time";
  }
  return "";
}

std::string describe_value(const SceneValue& value) {
  switch (value.kind) {
    case SceneValue::Kind::text:
      return "\"" + make_printable(value.text) + "\"";
    case SceneValue::Kind::integer:
      return std::to_string(value.integer);
    case SceneValue::Kind::number:
      return format_number(value.number);
    case SceneValue::Kind::boolean:
      return value.boolean ? "true" : "false";
    case SceneValue::Kind::list:
      return fmt::format("a list of {} {}", value.n_children, value.n_children == 1 ? "value" : "values");
    default:
      return describe_kind(value.kind);
  }
}

std::string make_printable(const std::string& text) {
  std::string shown = text;
  if (text.size() > n_characters_shown) {
    std::size_t end = n_characters_shown;
    while (end > 0 && (static_cast<unsigned char>(text[end]) & 0xc0) == 0x80) --end;  // not inside a UTF-8 sequence
    shown = text.substr(0, end) + "...";
  }
  std::replace_if(shown.begin(), shown.end(), is_control, ' ');
  return shown;
}

std::string format_number(const double number) {
  const std::string digits = fmt::format("{}", number);
  return digits.find_first_of(".en") == std::string::npos ? digits + ".0" : digits;
}

std::string format_text(const std::string& text) {
  std::string quoted = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') {
      quoted += fmt::format("\\{}", c);
    } else if (is_control(c)) {
      quoted += fmt::format("\\u{:04x}", static_cast<unsigned char>(c));
    } else {
      quoted += c;
    }
  }
  return quoted + '"';
}

}  // namespace skein
