#include "overrides.hpp"

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

bool is_repeatable(const std::string& table) { return table == "fiber" || table == "flow"; }

// "fiber[1]" -> "fiber" and 1
std::optional<std::size_t> take_index(std::string& name) {
  const auto open = name.find('[');
  if (open == std::string::npos) return std::nullopt;
  std::size_t index = 0;
  const char *first = name.data() + open + 1, *last = name.data() + name.size();
  const auto [end, error] = std::from_chars(first, last, index);
  if (error != std::errc() || end + 1 != last || *end != ']' || !is_repeatable(name.substr(0, open))) {
    throw OverrideError{"an index counts fibers or flows from 0, as in fiber[1].roll=30.0"};
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
    throw OverrideError{"name a key of the fiber, as in fiber[1].roll=30.0"};
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

std::vector<SceneValue*> find_instances(SceneValue& root, const std::string& name,
                                        const std::optional<std::size_t> index) {
  SceneValue* table = root.find(name);
  if (table == nullptr) throw OverrideError{fmt::format("the scene has no {} to change", name)};
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

void apply(SceneValue& root, const Override& override, const Place& place) {
  const auto& path = override.path;
  if (path.size() == 1) {
    set_child(root, path[0], override.value);
  } else if (is_repeatable(path[0])) {
    if (path[0] == "flow" && root.find("flow") == nullptr) find_or_add_table(root, path[0], place);
    for (SceneValue* instance : find_instances(root, path[0], override.instance))
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
      Override override = parse_override(source.overrides()[i]);
      set_places(override.value, place);
      apply(root, override, place);
    } catch (const OverrideError& error) {
      problems.push_back({source.locate(place), error.message, ""});
    }
  }
}

}  // namespace skein
