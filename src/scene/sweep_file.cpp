#include <skein/scene/sweep_file.hpp>

#include "sweep_parameter.hpp"
#include "table_reader.hpp"
#include "toml_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <sstream>
#include <utility>

namespace skein {
namespace {

constexpr const char* picture_examples =
    "\"half_period over fiber.sections\", \"regime over length by fiber.roll\" or \"regime over fiber.sections and "
    "fluid.viscosity\"";

/// Texts of a list, with their places.
std::vector<const SceneValue*> read_texts(TableReader& reader, const std::string& key, const char* example) {
  std::vector<const SceneValue*> texts;
  const SceneValue* list = reader.find(key);
  if (list == nullptr) return texts;
  if (list->kind != SceneValue::Kind::list) {
    reader.refuse(*list,
                  fmt::format("{} must be a list of texts, such as [{}], not {}", key, example, describe_value(*list)));
    return texts;
  }
  for (const SceneValue& child : list->children) {
    if (child.kind == SceneValue::Kind::text)
      texts.push_back(&child);
    else
      reader.refuse(child, fmt::format("{} must be texts, such as {}, not {}", key, example, describe_value(child)));
  }
  return texts;
}

/// Gives each parameter its axis.
/// @param is_zipped  all have one
void set_axes(std::vector<ReadParameter>& parameters, const bool is_zipped, TableReader& reader, SweepConfig& sweep) {
  for (std::size_t p = 0; p < parameters.size(); ++p) {
    SweepParameter& parameter = parameters[p].parameter;
    const auto earlier = [&](const std::string& key) {
      const auto end = parameters.begin() + static_cast<std::ptrdiff_t>(p);
      const auto found =
          std::find_if(parameters.begin(), end, [&](const auto& other) { return other.parameter.key == key; });
      return found == end ? nullptr : &found->parameter;
    };
    if (earlier(parameter.key) != nullptr)
      reader.refuse(*parameters[p].table, fmt::format("there are two parameters {}", parameter.key));
    const SweepParameter* leader = is_zipped && p > 0 ? &parameters[0].parameter : nullptr;
    if (!parameters[p].with.empty()) {
      leader = earlier(parameters[p].with);
      if (leader == nullptr)
        reader.refuse(*parameters[p].table, fmt::format("{} goes with '{}', which is no parameter before it",
                                                        parameter.key, make_printable(parameters[p].with)));
    }
    parameter.axis = leader == nullptr ? sweep.n_axes++ : leader->axis;
    if (leader != nullptr && leader->values.size() != parameter.values.size() && !leader->values.empty() &&
        !parameter.values.empty())
      reader.refuse(*parameters[p].table,
                    fmt::format("{} has {} values and {}, with which it goes, has {}", parameter.key,
                                parameter.values.size(), leader->key, leader->values.size()));
  }
}

void read_parameters(TableReader& reader, const SceneSource& source, std::vector<Problem>& problems,
                     SweepConfig& sweep) {
  std::size_t combination = 0;
  reader.read("combine", {"crossed", "zipped"}, combination);
  reader.read("seed", sweep.seed);
  const SceneValue* tables = reader.find("parameter");
  if (tables == nullptr) return reader.refuse("a sweep needs at least one [[parameter]], with a key and its values");
  if (tables->kind != SceneValue::Kind::table && !tables->is_list_of_tables())
    return reader.refuse(*tables, "parameter must be a table: write [[parameter]]");

  std::vector<ReadParameter> parameters;
  if (tables->kind == SceneValue::Kind::table)
    parameters.push_back(read_sweep_parameter(*tables, sweep.seed, source, problems));
  else
    for (const SceneValue& table : tables->children)
      parameters.push_back(read_sweep_parameter(table, sweep.seed, source, problems));
  set_axes(parameters, combination == 1, reader, sweep);
  double n_runs = 1.0;
  std::vector<bool> is_counted(sweep.n_axes, false);
  for (ReadParameter& read : parameters) {
    if (!is_counted[read.parameter.axis]) n_runs *= static_cast<double>(read.parameter.values.size());
    is_counted[read.parameter.axis] = true;
    sweep.parameters.push_back(std::move(read.parameter));
  }
  if (n_runs > static_cast<double>(most_sweep_runs))
    reader.refuse(*tables, fmt::format("{:.0f} runs are more than {}", n_runs, most_sweep_runs));
}

}  // namespace

SweepPicture read_sweep_picture(const std::string& words) {
  std::istringstream stream(words);
  std::vector<std::string> parts;
  for (std::string part; stream >> part;) parts.push_back(part);
  const bool is_curve = parts.size() >= 3 && parts[1] == "over";
  if (is_curve && parts.size() == 3) return {parts[0], parts[2], "", "", 0, 0};
  if (is_curve && parts.size() == 5 && parts[3] == "and") return {parts[0], parts[2], parts[4], "", 0, 0};
  if (is_curve && parts.size() == 5 && parts[3] == "by") return {parts[0], parts[2], "", parts[4], 0, 0};
  throw Error(ExitCode::usage, fmt::format("'{}' is no picture: write {}", make_printable(words), picture_examples));
}

SweepConfig read_sweep(const std::filesystem::path& file) {
  const SceneSource source(file.string(), {});
  const SceneValue root = parse_toml_file(read_toml_file(file, sweep_file), source, sweep_file);
  std::vector<Problem> problems;
  SweepConfig sweep;
  TableReader reader(root, "the top of the file", source, problems);
  reader.read("title", sweep.title);
  std::string scene;
  if (reader.read("scene", scene)) sweep.scene = file.parent_path() / scene;
  if (root.find("scene") == nullptr) reader.refuse("a sweep needs scene = \"FILE\", of which its runs are changes");
  for (const SceneValue* change : read_texts(reader, "changes", "\"time.end=20.0\"")) {
    sweep.changes.push_back(change->text);
    sweep.change_places.emplace_back(change->place.line, change->place.column);
  }
  for (const SceneValue* picture : read_texts(reader, "pictures", "\"half_period over fiber.sections\"")) {
    try {
      sweep.pictures.push_back(read_sweep_picture(picture->text));
      sweep.pictures.back().line = picture->place.line;
      sweep.pictures.back().column = picture->place.column;
    } catch (const Error& error) {
      reader.refuse(*picture, error.what());
    }
  }
  read_parameters(reader, source, problems, sweep);
  reader.refuse_unknown();
  sort_problems(problems);
  if (!problems.empty()) throw SceneError(file.string(), std::move(problems), sweep_file.name);
  return sweep;
}

}  // namespace skein
