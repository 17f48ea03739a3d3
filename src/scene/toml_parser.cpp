#include "toml_parser.hpp"

#include "toml_library.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <string_view>
#include <utility>

namespace skein {
namespace {

constexpr int n_key_parts_allowed = 32;

Place make_place(const toml::source_position& position) {
  return {static_cast<int>(position.line), static_cast<int>(position.column)};
}

// The parser bounds the nesting of values, not that of keys (a.b.c. ...), whose tables would then be destroyed one
// inside the other until the stack is full. Strings and comments are passed over as TOML has them; a text that is no
// TOML may be misread, but only behind the place at which the parser stops.
class KeyDepthCheck {
 public:
  explicit KeyDepthCheck(const std::string_view text) : text_(text) {}

  void run() {
    while (at_ < text_.size()) {
      const char c = text_[at_];
      if (c == '"' || c == '\'') {
        skip_string(c);
        continue;
      }
      if (c == '#') {
        at_ = std::min(text_.find('\n', at_), text_.size());
        continue;
      }
      if (c == '.' && ++n_dots_ >= n_key_parts_allowed) {
        throw SyntaxError{find_place(), fmt::format("a key of more than {} parts", n_key_parts_allowed)};
      }
      if (std::string_view("\n=,[{").find(c) != std::string_view::npos) n_dots_ = 0;
      ++at_;
    }
  }

 private:
  void skip_string(const char quote) {
    const std::string three(3, quote);  // opens and closes a multi-line string
    const bool multi_line = text_.substr(at_, 3) == three;
    const std::string_view end = multi_line ? std::string_view(three) : std::string_view(three).substr(0, 1);
    at_ += end.size();
    while (at_ < text_.size() && text_.substr(at_, end.size()) != end) {
      if (!multi_line && text_[at_] == '\n') return;
      at_ += quote == '"' && text_[at_] == '\\' ? 2 : 1;
    }
    at_ += end.size();
    while (multi_line && at_ < text_.size() && text_[at_] == quote) ++at_;  // up to two may stand before the end
  }

  Place find_place() const {
    const auto before = text_.substr(0, at_);
    const auto n_lines = std::count(before.begin(), before.end(), '\n');
    return {static_cast<int>(n_lines) + 1, static_cast<int>(at_ - (before.rfind('\n') + 1)) + 1};
  }

  std::string_view text_;
  std::size_t at_ = 0;
  int n_dots_ = 0;
};

SceneValue convert(const toml::node& node, const ParseLimits& limits, int level);

void add_children(SceneValue& value, const toml::table& table, const ParseLimits& limits, const int level) {
  for (const auto& [key, child] : table) {
    SceneValue converted = convert(child, limits, level + 1);
    converted.name = std::string(key.str());
    converted.name_place = make_place(key.source().begin);
    value.children.push_back(std::move(converted));
  }
}

void add_children(SceneValue& value, const toml::array& list, const ParseLimits& limits, const int level) {
  for (const auto& child : list) {
    if (!child.is_table() && value.children.size() >= limits.list_values) continue;
    value.children.push_back(convert(child, limits, level + 1));
  }
}

SceneValue convert(const toml::node& node, const ParseLimits& limits, const int level) {
  SceneValue value;
  value.place = make_place(node.source().begin);
  if (const auto* table = node.as_table()) {
    value.kind = SceneValue::Kind::table;
    value.n_children = table->size();
    if (level < limits.levels) add_children(value, *table, limits, level);
  } else if (const auto* list = node.as_array()) {
    value.kind = SceneValue::Kind::list;
    value.n_children = list->size();
    if (level < limits.levels) add_children(value, *list, limits, level);
  } else if (const auto* text = node.as_string()) {
    value.kind = SceneValue::Kind::text;
    value.text = text->get();
  } else if (const auto* integer = node.as_integer()) {
    value.kind = SceneValue::Kind::integer;
    value.integer = integer->get();
  } else if (const auto* number = node.as_floating_point()) {
    value.kind = SceneValue::Kind::number;
    value.number = number->get();
  } else if (const auto* boolean = node.as_boolean()) {
    value.kind = SceneValue::Kind::boolean;
    value.boolean = boolean->get();
  } else {
    value.kind = SceneValue::Kind::moment;
  }
  return value;
}

// The parser's words, clearer where scenes often go wrong.
std::string explain(const std::string& description) {
  if (description.find("cannot redefine existing") != std::string::npos) {
    const auto name = description.find('\'');
    return (name == std::string::npos ? "a key" : description.substr(name)) + " is there twice";
  }
  if (description.find("could not determine value type") != std::string::npos)
    return "this is no value; text needs quotes";
  return description;
}

}  // namespace

SceneValue parse_toml(const std::string& text, const ParseLimits& limits) {
  KeyDepthCheck(text).run();
  try {
    return convert(toml::parse(std::string_view(text)), limits, 0);
  } catch (const toml::parse_error& error) {
    throw SyntaxError{make_place(error.source().begin), explain(std::string(error.description()))};
  }
}

}  // namespace skein
