#include "table_reader.hpp"

#include <skein/scene/nearest_name.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace skein {
namespace {

std::string suggest(const std::string& name, const std::vector<std::string>& known) {
  const std::string nearest = find_nearest_name(name, known);
  return nearest.empty() ? "" : fmt::format("; did you mean '{}'?", nearest);
}

}  // namespace

const SceneValue* TableReader::find(const std::string& key) {
  known_.push_back(key);
  return table_.find(key);
}

void TableReader::refuse(const SceneValue& where, const std::string& message) {
  problems_.push_back({source_.locate(where.place), message, ""});
}

bool TableReader::check(const SceneValue& value, const std::string& key, const bool fits, const std::string& wanted) {
  if (!fits) refuse(value, fmt::format("{} must be {}, not {}", key, wanted, describe_value(value)));
  return fits;
}

bool TableReader::read(const std::string& key, std::string& value) {
  const SceneValue* given = find(key);
  if (given == nullptr || !check(*given, key, given->kind == SceneValue::Kind::text, "text in quotes")) return false;
  value = given->text;
  return true;
}

bool TableReader::read(const std::string& key, double& value) {
  const SceneValue* given = find(key);
  if (given == nullptr) return false;
  const double number = to_number(*given);
  if (!check(*given, key, std::isfinite(number), "a finite number")) return false;
  value = number;
  return true;
}

bool TableReader::read(const std::string& key, std::uint64_t& value) {
  const SceneValue* given = find(key);
  if (given == nullptr) return false;
  const bool is_count = given->kind == SceneValue::Kind::integer && given->integer >= 0;
  if (!check(*given, key, is_count, "an integer, 0 or more")) return false;
  value = static_cast<std::uint64_t>(given->integer);
  return true;
}

bool TableReader::read(const std::string& key, const std::vector<std::string>& words, std::size_t& chosen) {
  std::string word;
  if (!read(key, word)) return false;
  const auto found = std::find(words.begin(), words.end(), word);
  chosen = static_cast<std::size_t>(found - words.begin());
  if (found == words.end())
    refuse(*table_.find(key), fmt::format("{} must be one of {}, not \"{}\"{}", key, fmt::join(words, ", "),
                                          make_printable(word), suggest(word, words)));
  return found != words.end();
}

void TableReader::refuse_unknown() {
  for (const SceneValue& child : table_.children) {
    if (std::find(known_.begin(), known_.end(), child.name) != known_.end()) continue;
    std::string hint = suggest(child.name, known_);
    if (hint.empty()) hint = fmt::format("; known are {}", fmt::join(known_, ", "));
    problems_.push_back({source_.locate(child.name_place),
                         fmt::format("unknown key '{}' in {}{}", make_printable(child.name), name_, hint), ""});
  }
}

}  // namespace skein
