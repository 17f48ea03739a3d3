#include "sweep_parameter.hpp"

#include <skein/scene/nearest_name.hpp>
#include <skein/scene/scene_reference.hpp>

#include "sweep_values.hpp"
#include "table_reader.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace skein {
namespace {

constexpr const char* example = "values = [1.0, 2.0], or from, to and count";

/// "fiber[1].roll" -> "fiber.roll"
std::string without_index(const std::string& key) {
  const auto open = key.find('['), close = key.find(']');
  return open == std::string::npos || close == std::string::npos || close < open
             ? key
             : key.substr(0, open) + key.substr(close + 1);
}

/// Nothing but its path where scenes do not have it, which is a problem.
KeyName find_key(const std::string& key, TableReader& reader, const SceneValue& place) {
  std::vector<std::string> known;
  for (const KeyName& name : list_keys()) {
    if (name.path == without_index(key)) return name;
    known.push_back(name.path);
  }
  const std::string nearest = find_nearest_name(key, known);
  reader.refuse(place, fmt::format("scenes have no key '{}'{}", make_printable(key),
                                   nearest.empty() ? "; 'skein defaults' lists them"
                                                   : fmt::format("; did you mean '{}'?", nearest)));
  return {key, {}, false};
}

bool is_plain(const SceneValue& value) {
  using Kind = SceneValue::Kind;
  if (value.kind == Kind::list)
    return value.children.size() == value.n_children &&
           std::all_of(value.children.begin(), value.children.end(), is_plain);
  return value.kind != Kind::table && value.kind != Kind::moment;
}

void add_listed(const SceneValue& list, TableReader& reader, SweepParameter& parameter) {
  if (list.kind != SceneValue::Kind::list || list.n_children == 0)
    return reader.refuse(list, fmt::format("values must be a list of at least one, not {}", describe_value(list)));
  if (list.n_children > most_sweep_runs)
    return reader.refuse(list, fmt::format("{} values are more than {}", list.n_children, most_sweep_runs));
  for (const SceneValue& value : list.children) {
    if (!is_plain(value))
      reader.refuse(value, fmt::format("a value must be a number, text, true or false, or a list of these, not {}",
                                       describe_value(value)));
    else
      parameter.values.push_back({format_value(value), to_number(value), value.place.line, value.place.column});
  }
}

/// The ends and the number of values, if all are there and make sense together.
bool read_range(const SceneValue& table, TableReader& reader, SweepRange& range) {
  std::uint64_t count = 0;
  std::size_t spacing = 0;
  const bool has_from = reader.read("from", range.from), has_to = reader.read("to", range.to);
  const bool has_count = reader.read("count", count);
  const SceneValue* spacing_value = reader.find("spacing");
  if (spacing_value != nullptr &&
      !reader.read("spacing", {"linear", "logarithmic", "random", "random_logarithmic"}, spacing))
    return false;
  range.count = count;
  range.spacing = static_cast<SweepSpacing>(spacing);
  for (const char* key : {"from", "to", "count"})
    if (table.find(key) == nullptr) reader.refuse(fmt::format("a range needs from, to and count: there is no {}", key));
  if (!has_from || !has_to || !has_count) return false;
  const bool is_logarithmic =
      range.spacing == SweepSpacing::logarithmic || range.spacing == SweepSpacing::random_logarithmic;
  if (count < 1 || count > most_sweep_runs)
    reader.refuse(*table.find("count"), fmt::format("count must be 1 to {}, not {}", most_sweep_runs, count));
  else if (is_logarithmic && !(range.from > 0.0 && range.to > 0.0))
    reader.refuse(*table.find(range.from > 0.0 ? "to" : "from"), "a logarithmic range has both ends above 0");
  else
    return true;
  return false;
}

void add_range(const SceneValue& table, const std::uint64_t seed, const bool is_integer, TableReader& reader,
               SweepParameter& parameter) {
  SweepRange range;
  if (!read_range(table, reader, range)) return;
  const SceneValue& from = *table.find("from");
  constexpr double largest_exact = 9007199254740992.0;  // 2^53
  if (is_integer && !(std::abs(range.from) < largest_exact && std::abs(range.to) < largest_exact))
    return reader.refuse(from, fmt::format("{} is an integer: ends are below 2^53", parameter.key));
  parameter.is_drawn = range.spacing == SweepSpacing::random || range.spacing == SweepSpacing::random_logarithmic;
  for (double number : spread_values(range, seed, parameter.key)) {
    if (is_integer) number = std::round(number);
    std::string text = is_integer ? fmt::format("{}", static_cast<std::int64_t>(number)) : format_number(number);
    if (!parameter.is_drawn && !parameter.values.empty() && parameter.values.back().text == text)
      return reader.refuse(*table.find("count"),
                           fmt::format("{} from {} to {} are not {} different values: ask for fewer", parameter.key,
                                       describe_value(from), describe_value(*table.find("to")), range.count));
    parameter.values.push_back({std::move(text), number, from.place.line, from.place.column});
  }
}

}  // namespace

ReadParameter read_sweep_parameter(const SceneValue& table, const std::uint64_t seed, const SceneSource& source,
                                   std::vector<Problem>& problems) {
  ReadParameter read{{}, "", &table};
  TableReader reader(table, "[[parameter]]", source, problems);
  KeyName name;
  if (reader.read("key", read.parameter.key)) name = find_key(read.parameter.key, reader, *table.find("key"));
  if (table.find("key") == nullptr) reader.refuse("a parameter needs key, such as key = \"fiber.sections\"");
  reader.read("with", read.with);

  const SceneValue* listed = reader.find("values");
  bool has_range = false;
  for (const char* key : {"from", "to", "count", "spacing"}) has_range = has_range || reader.find(key) != nullptr;
  if (listed != nullptr && has_range)
    reader.refuse(*listed, fmt::format("a parameter has one of them: {}", example));
  else if (listed != nullptr)
    add_listed(*listed, reader, read.parameter);
  else if (!has_range)
    reader.refuse(fmt::format("a parameter needs {}", example));
  else
    add_range(table, seed, name.is_integer, reader, read.parameter);
  reader.refuse_unknown();
  return read;
}

}  // namespace skein
