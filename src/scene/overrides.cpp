#include "overrides.hpp"

#include <skein/core/utf8.hpp>

#include "repeatable_tables.hpp"
#include "toml_parser.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <optional>
#include <string>
#include <utility>

namespace skein {
namespace {

/// What makes an override useless; the text of a Problem.
struct OverrideError {
  std::string message;
};

struct Override {
  std::vector<std::string> path;        ///< table and key, or key
  std::optional<std::size_t> instance;  ///< of fiber[1].key
  SceneValue value;
};

// A scene's file is UTF-8, or it is refused; what a run writes into its folder must be read back.
void check_is_utf8(const std::string& override) {
  const std::size_t fault = find_utf8_fault(override);
  if (fault == std::string::npos) return;
  throw OverrideError{fmt::format(
      "its byte {}, 0x{:02x}, is no UTF-8; write the text in UTF-8 (a terminal of another encoding may have sent it)",
      fault + 1, static_cast<unsigned char>(override[fault]))};
}

void set_places(SceneValue& value, const Place& place) {
  value.place = value.name_place = place;
  for (SceneValue& child : value.children) set_places(child, place);
}

SceneValue make_text(const std::string& word) {
  SceneValue value;
  value.kind = SceneValue::Kind::text;
  value.text = word;
  return value;
}

SceneValue parse_value(const std::string& text) {
  const auto first = text.find_first_not_of(" \t");
  const bool is_bare = first == std::string::npos || std::string("\"'[{").find(text[first]) == std::string::npos;
  try {
    SceneValue root = parse_toml("value = " + text);
    if (root.n_children == 1) return root.children.front();
  } catch (const SyntaxError& error) {
    if (is_bare && text.find('\n') == std::string::npos) return make_text(text);
    throw OverrideError{"the value is not valid TOML: " + error.message};
  }
  throw OverrideError{"more than one value"};
}

std::vector<std::string> split(const std::string& path) {
  std::vector<std::string> parts(1);
  for (const char c : path) {
    if (c == '.') {
      parts.emplace_back();
    } else {
      parts.back() += c;
    }
  }
  return parts;
}

/// "fibers or flows"
std::string list_repeatable_tables() {
  std::vector<std::string> names;
  for (const RepeatableTable& table : repeatable_tables()) names.push_back(table.name + "s");
  std::sort(names.begin(), names.end());
  return fmt::format("{}", fmt::join(names, " or "));
}

// "fiber[1]" -> "fiber" and 1
std::optional<std::size_t> take_index(std::string& name) {
  const auto open = name.find('[');
  if (open == std::string::npos) return std::nullopt;
  std::size_t index = 0;
  const char *first = name.data() + open + 1, *last = name.data() + name.size();
  const auto [end, error] = std::from_chars(first, last, index);
  if (error != std::errc() || end + 1 != last || *end != ']' ||
      find_repeatable_table(name.substr(0, open)) == nullptr) {
    throw OverrideError{fmt::format("an index counts {} from 0, as in fiber[1].roll=30.0", list_repeatable_tables())};
  }
  name.resize(open);
  return index;
}

Override parse_override(const std::string& text) {
  const auto equals = text.find('=');
  Override parsed;
  parsed.path = split(text.substr(0, equals));
  const bool has_gap = std::find(parsed.path.begin(), parsed.path.end(), "") != parsed.path.end();
  if (equals == std::string::npos || has_gap || parsed.path.size() > 2) {
    throw OverrideError{"write TABLE.KEY=VALUE, as in fiber.sections=113"};
  }
  parsed.instance = take_index(parsed.path.front());
  if (parsed.instance && parsed.path.size() < 2)
    throw OverrideError{fmt::format("name a key of the {}, as in fiber[1].roll=30.0", parsed.path.front())};
  parsed.value = parse_value(text.substr(equals + 1));
  return parsed;
}

void set_child(SceneValue& table, const std::string& name, const SceneValue& value) {
  SceneValue* child = table.find(name);
  if (child == nullptr) {
    child = &table.children.emplace_back();
    ++table.n_children;
  }
  *child = value;
  child->name = name;
}

SceneValue& find_or_add_table(SceneValue& root, const std::string& name, const Place& place) {
  if (SceneValue* found = root.find(name)) {
    if (found->kind != SceneValue::Kind::table) throw OverrideError{fmt::format("'{}' is no table", name)};
    return *found;
  }
  SceneValue table;
  set_places(table, place);
  set_child(root, name, table);
  return *root.find(name);
}

/// Makes the table where the scene has none and that stands for one.
std::vector<SceneValue*> find_instances(SceneValue& root, const RepeatableTable& wanted,
                                        const std::optional<std::size_t> index, const Place& place) {
  const std::string& name = wanted.name;
  if (wanted.when_absent == WhenAbsent::stands_for_one && root.find(name) == nullptr)
    find_or_add_table(root, name, place);
  SceneValue* table = root.find(name);
  if (table == nullptr) {
    std::string message = fmt::format("the scene has no {} to change", name);
    if (index) message = fmt::format("there is no {}[{}]: ", name, *index) + message;
    // A required table's absence is a problem of its own, which says the same.
    if (wanted.when_absent == WhenAbsent::stands_for_none) message += fmt::format("; write [{}] in it first", name);
    throw OverrideError{message};
  }
  std::vector<SceneValue*> instances;
  if (table->kind == SceneValue::Kind::table) instances.push_back(table);
  if (table->is_list_of_tables()) {
    for (SceneValue& child : table->children) instances.push_back(&child);
  }
  if (!index) return instances;
  if (*index >= instances.size()) {
    throw OverrideError{fmt::format("there is no {0}[{1}]: the scene's last is {0}[{2}]", name, *index,
                                    static_cast<std::ptrdiff_t>(instances.size()) - 1)};
  }
  return {instances[*index]};
}

void apply(SceneValue& root, const Override& override, const Place& place) {
  const auto& path = override.path;
  if (path.size() == 1) {
    set_child(root, path[0], override.value);
  } else if (const RepeatableTable* table = find_repeatable_table(path[0])) {
    for (SceneValue* instance : find_instances(root, *table, override.instance, place))
      set_child(*instance, path[1], override.value);
  } else {
    set_child(find_or_add_table(root, path[0], place), path[1], override.value);
  }
}

}  // namespace

void apply_overrides(SceneValue& root, const SceneSource& source, std::vector<Problem>& problems) {
  for (std::size_t i = 0; i < source.overrides().size(); ++i) {
    const Place place{0, 0, static_cast<int>(i)};
    try {
      check_is_utf8(source.overrides()[i]);
      Override override = parse_override(source.overrides()[i]);
      set_places(override.value, place);
      apply(root, override, place);
    } catch (const OverrideError& error) {
      problems.push_back({source.locate(place), error.message, ""});
    }
  }
}

}  // namespace skein
