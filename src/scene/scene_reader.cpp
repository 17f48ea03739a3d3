#include "scene_reader.hpp"

#include <skein/scene/nearest_name.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace skein {
namespace {

constexpr std::size_t n_instances_allowed = 100000;
// More are never shown; a file of garbage need not be searched to its end.
constexpr std::size_t n_problems_kept = 1000;

// The bounds themselves where the short text would not explain why the number is refused.
std::string describe_range(const Range& range, const double number) {
  const bool too_large = number > range.high, too_small = number > 0.0 && number < range.low;
  const bool shows_bounds = range.text.find(" to ") != std::string::npos;
  const bool shows_enough = shows_bounds || !(range.text.empty() || too_large || too_small);
  return shows_enough ? range.text : fmt::format("{:g} to {:g}", range.low, range.high);
}

bool is_number(const SceneValue& value) {
  return value.kind == SceneValue::Kind::number || value.kind == SceneValue::Kind::integer;
}

/// Collects the tables that have a key of some name.
class KeyOwners : public KeyVisitor {
 public:
  explicit KeyOwners(std::string name) : name_(std::move(name)) {}
  void begin_table(const Table& table) override { table_ = table.name; }
  void end_table() override {}
  void text(const Key& key, std::string&) override { compare(key); }
  void choice(const Key& key, const std::vector<Choice>&, std::size_t&) override { compare(key); }
  void integer(const Key& key, std::int64_t&) override { compare(key); }
  void number(const Key& key, double&) override { compare(key); }
  void vector(const Key& key, Vec3&) override { compare(key); }
  void profile(const Key& key, std::vector<ProfilePoint>&) override { compare(key); }
  void numbers(const Key& key, std::vector<double>&) override { compare(key); }

  std::vector<std::string> owners;

 private:
  void compare(const Key& key) {
    if (key.name == name_) owners.push_back(table_.empty() ? "the top of the file" : "[" + table_ + "]");
  }
  std::string name_, table_;
};

std::vector<std::string> find_owners(const std::string& key) {
  KeyOwners visitor(key);
  SceneConfig scene = make_scene_with_every_table();
  visit_keys(visitor, scene);
  return visitor.owners;
}

}  // namespace

Origin SceneSource::locate(const Place& place) const {
  if (place.override_index < 0) return {name_, place.line, place.column, -1};
  return {"--set " + make_printable(overrides_[static_cast<std::size_t>(place.override_index)]), 0, 0,
          place.override_index};
}

SceneReader::SceneReader(const SceneValue& root, const SceneSource& source) : root_(root), source_(source) {
  for (const RepeatableTable& table : repeatable_tables()) find_instances(table);
}

void SceneReader::find_instances(const RepeatableTable& table) {
  std::vector<const SceneValue*>& found = instances_[table.name];
  const SceneValue* value = root_.find(table.name);
  if (value == nullptr) {
    if (table.when_absent == WhenAbsent::is_an_error)
      problems_.push_back(
          {source_.locate({1, 1}), fmt::format("the scene has no {0}: write at least [{0}]", table.name), ""});
  } else if (value->kind == SceneValue::Kind::table) {
    found.push_back(value);
  } else if (!value->is_list_of_tables()) {
    problems_.push_back({source_.locate(value->place),
                         fmt::format("{0} must be a table: write [{0}], or [[{0}]] for several", table.name), ""});
  } else if (value->children.size() > n_instances_allowed) {
    problems_.push_back(
        {source_.locate(value->place),
         fmt::format("{} {}s are more than {}", value->children.size(), table.name, n_instances_allowed), ""});
  } else {
    for (const SceneValue& child : value->children) found.push_back(&child);
  }
  if (found.empty() && table.when_absent == WhenAbsent::stands_for_one) found.push_back(nullptr);
}

std::string SceneReader::path_of(const std::string& table, const std::size_t instance) const {
  return n_instances(table) > 1 ? fmt::format("{}[{}]", table, instance) : table;
}

const SceneValue* SceneReader::find_table(const Table& table) {
  if (table.repeatable) {
    std::size_t& n_read = n_instances_read_[table.name];
    if (n_read == 0) root_known_.push_back(table.name);
    return instances_.at(table.name)[n_read++];
  }
  root_known_.push_back(table.name);
  const SceneValue* found = root_.find(table.name);
  if (found == nullptr || found->kind == SceneValue::Kind::table) return found;
  const char* message = found->is_list_of_tables() ? "{0} can be there once only: write [{0}]"
                                                   : "{0} must be a table: write [{0}] on a line of its own";
  problems_.push_back({source_.locate(found->place), fmt::format(fmt::runtime(message), table.name), table.meaning});
  unsound_.insert(table.name);
  return nullptr;
}

void SceneReader::begin_table(const Table& table) {
  inside_table_ = !table.name.empty();
  if (!inside_table_) {
    table_ = &root_;
    return;
  }
  table_path_ = table.repeatable ? path_of(table.name, n_instances_read_[table.name]) : table.name;
  table_known_.clear();
  table_ = find_table(table);
}

void SceneReader::end_table() {
  if (!inside_table_) {
    for (const auto& [name, found] : instances_)  // a table without instances is not shown to visitors
      if (found.empty()) root_known_.push_back(name);
  }
  const SceneValue* finished = inside_table_ ? table_ : &root_;
  if (finished != nullptr) {
    for (const SceneValue& child : finished->children) reject_unknown(child);
  }
  inside_table_ = false;
}

std::string SceneReader::path_of(const std::string& key) const { return inside_table_ ? table_path_ + "." + key : key; }

void SceneReader::reject_unknown(const SceneValue& child) {
  const auto& known = inside_table_ ? table_known_ : root_known_;
  if (std::find(known.begin(), known.end(), child.name) != known.end()) return;
  if (problems_.size() >= n_problems_kept) return;

  const bool is_table = !inside_table_ && (child.kind == SceneValue::Kind::table || child.is_list_of_tables());
  std::string message = fmt::format("unknown {} '{}'", is_table ? "table" : "key", make_printable(child.name));
  if (inside_table_) message += fmt::format(" in [{}]", table_path_.substr(0, table_path_.find('[')));

  const std::string nearest = find_nearest_name(child.name, known);
  const auto owners = is_table ? std::vector<std::string>() : find_owners(child.name);
  std::string doc;
  if (!owners.empty()) {
    message += fmt::format("; it belongs in {}", fmt::join(owners, " or "));
  } else if (!nearest.empty()) {
    message += fmt::format("; did you mean '{}'?", nearest);
    const auto found = doc_.find(path_of(nearest));
    if (found != doc_.end()) doc = found->second;
  } else {
    message += fmt::format("; known are {}", fmt::join(known, ", "));
  }
  problems_.push_back({source_.locate(child.name_place), message, doc});
}

const SceneValue* SceneReader::find_value(const Key& key, const std::string& default_value) {
  (inside_table_ ? table_known_ : root_known_).push_back(key.name);
  const std::string path = path_of(key.name);
  const SceneValue* value = table_ == nullptr ? nullptr : table_->find(key.name);
  doc_[path] = describe_key(path, key, default_value);
  place_[path] = value != nullptr ? value->place : table_ != nullptr ? table_->place : Place{1, 1};
  return value;
}

void SceneReader::reject(const SceneValue& value, const Key& key, const std::string& message) {
  const std::string path = path_of(key.name);
  problems_.push_back({source_.locate(value.place), path + " " + message, doc_[path]});
  unsound_.insert(inside_table_ ? table_path_ : "");
}

bool SceneReader::check_kind(const SceneValue& value, const bool fits, const Key& key, const char* wanted) {
  if (!fits) reject(value, key, fmt::format("must be {}, not {}", wanted, describe_value(value)));
  return fits;
}

bool SceneReader::check_number(const SceneValue& value, const double number, const Key& key) {
  const bool may_be_infinite = !std::isnan(number) && number > 0.0 && std::isinf(key.range.high);
  if (!std::isfinite(number) && !may_be_infinite) {
    reject(value, key, fmt::format("must be a finite number, not {}", number));
  } else if (number < key.range.low || number > key.range.high) {
    reject(
        value, key,
        fmt::format("must be {}, not {}", describe_range(key.range, number),
                    value.kind == SceneValue::Kind::integer ? std::to_string(value.integer) : format_number(number)));
  } else {
    return true;
  }
  return false;
}

void SceneReader::text(const Key& key, std::string& value) {
  const SceneValue* given = find_value(key, format_text(value));
  if (given != nullptr && check_kind(*given, given->kind == SceneValue::Kind::text, key, "text in quotes")) {
    value = given->text;
  }
}

void SceneReader::choice(const Key& key, const std::vector<Choice>& choices, std::size_t& chosen) {
  const SceneValue* given = find_value(key, format_text(choices[chosen].word));
  if (given == nullptr) return;
  const std::string wanted = list_choices(choices);
  if (!check_kind(*given, given->kind == SceneValue::Kind::text, key, wanted.c_str())) return;

  std::vector<std::string> words;
  for (const Choice& choice : choices) words.push_back(choice.word);
  const auto found = std::find(words.begin(), words.end(), given->text);
  if (found != words.end()) {
    chosen = static_cast<std::size_t>(found - words.begin());
    return;
  }
  const std::string nearest = find_nearest_name(given->text, words);
  reject(*given, key,
         fmt::format("must be {}, not {}{}", wanted, describe_value(*given),
                     nearest.empty() ? "" : fmt::format("; did you mean '{}'?", nearest)));
}

void SceneReader::integer(const Key& key, std::int64_t& value) {
  const SceneValue* given = find_value(key, std::to_string(value));
  if (given == nullptr || !check_kind(*given, given->kind == SceneValue::Kind::integer, key, "an integer")) return;
  if (check_number(*given, static_cast<double>(given->integer), key)) value = given->integer;
}

void SceneReader::number(const Key& key, double& value) {
  const SceneValue* given = find_value(key, format_number(value));
  if (given == nullptr || !check_kind(*given, is_number(*given), key, "a number")) return;
  if (check_number(*given, to_number(*given), key)) value = to_number(*given);
}

void SceneReader::vector(const Key& key, Vec3& value) {
  const SceneValue* given = find_value(key, format_vector(value));
  if (given == nullptr) return;
  const bool has_three = given->kind == SceneValue::Kind::list && given->n_children == 3;
  if (!check_kind(*given, has_three, key, "a list of three numbers")) return;

  bool sound = true;
  for (const SceneValue& child : given->children) {
    sound = check_kind(child, is_number(child), key, "a list of three numbers") &&
            check_number(child, to_number(child), key) && sound;
  }
  const auto& c = given->children;
  if (sound) value = {to_number(c[0]), to_number(c[1]), to_number(c[2])};
}

void SceneReader::profile(const Key& key, std::vector<ProfilePoint>& value) {
  constexpr const char* wanted = "a list of 2 to 64 pairs [position, factor]";
  const SceneValue* given = find_value(key, format_profile(value));
  if (given == nullptr) return;
  const bool is_list = given->kind == SceneValue::Kind::list && given->n_children >= 2 && given->n_children <= 64;
  if (!check_kind(*given, is_list, key, wanted)) return;

  std::vector<ProfilePoint> points;
  for (const SceneValue& pair : given->children) {
    const bool has_two = pair.kind == SceneValue::Kind::list && pair.n_children == 2;
    if (!check_kind(pair, has_two, key, wanted)) return;
    for (const SceneValue& child : pair.children)
      if (!check_kind(child, is_number(child), key, wanted) || !check_number(child, to_number(child), key)) return;
    points.push_back({to_number(pair.children[0]), to_number(pair.children[1])});
  }
  value = points;
}

void SceneReader::numbers(const Key& key, std::vector<double>& value) {
  constexpr const char* wanted = "a list of up to 64 numbers";
  const SceneValue* given = find_value(key, format_numbers(value));
  if (given == nullptr) return;
  if (!check_kind(*given, given->kind == SceneValue::Kind::list && given->n_children <= 64, key, wanted)) return;
  std::vector<double> numbers;
  for (const SceneValue& child : given->children) {
    if (!check_kind(child, is_number(child), key, wanted) || !check_number(child, to_number(child), key)) return;
    numbers.push_back(to_number(child));
  }
  value = std::move(numbers);
}

void SceneReader::add(std::vector<Problem>& list, const std::string& path, const std::string& message) const {
  const auto place = place_.find(path);
  const auto doc = doc_.find(path);
  list.push_back({source_.locate(place == place_.end() ? Place{1, 1} : place->second), message,
                  doc == doc_.end() ? "" : doc->second});
}

}  // namespace skein
