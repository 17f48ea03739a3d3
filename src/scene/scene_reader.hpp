#pragma once

#include "repeatable_tables.hpp"
#include "scene_keys.hpp"
#include "scene_value.hpp"

#include <map>
#include <set>
#include <string>
#include <vector>

namespace skein {

/// Names the places of a scene's text.
class SceneSource {
 public:
  SceneSource(std::string name, std::vector<std::string> overrides)
      : name_(std::move(name)), overrides_(std::move(overrides)) {}

  const std::string& name() const { return name_; }
  const std::vector<std::string>& overrides() const { return overrides_; }
  Origin locate(const Place& place) const;

 private:
  std::string name_;
  std::vector<std::string> overrides_;
};

/// Takes the values of a scene from its tree; each that is missing or wrong stays as it was. After visit_keys,
/// problems() holds all that is wrong with single keys and tables.
class SceneReader : public KeyVisitor {
 public:
  SceneReader(const SceneValue& root, const SceneSource& source);

  /// How many instances of a repeatable table the scene must have when its keys are visited.
  std::size_t n_instances(const std::string& table) const { return instances_.at(table).size(); }

  void begin_table(const Table& table) override;
  void end_table() override;
  void text(const Key& key, std::string& value) override;
  void choice(const Key& key, const std::vector<Choice>& choices, std::size_t& chosen) override;
  void integer(const Key& key, std::int64_t& value) override;
  void number(const Key& key, double& value) override;
  void vector(const Key& key, Vec3& value) override;
  void profile(const Key& key, std::vector<ProfilePoint>& value) override;
  void numbers(const Key& key, std::vector<double>& value) override;

  std::vector<Problem>& problems() { return problems_; }

  /// Adds to a list what was found about a key; `path` is as in path_of("fiber", i) + ".blob".
  void add(std::vector<Problem>& list, const std::string& path, const std::string& message) const;

  /// False where a key of the table was wrong, so that checks of keys against each other have no ground.
  bool is_sound(const std::string& table) const { return !unsound_.contains(table); }

  /// "fiber", or "fiber[2]" where there are several.
  std::string path_of(const std::string& table, std::size_t instance) const;

 private:
  void find_instances(const RepeatableTable& table);
  const SceneValue* find_table(const Table& table);
  const SceneValue* find_value(const Key& key, const std::string& default_value);
  bool check_kind(const SceneValue& value, bool fits, const Key& key, const char* wanted);
  bool check_number(const SceneValue& value, double number, const Key& key);
  void reject(const SceneValue& value, const Key& key, const std::string& message);
  void reject_unknown(const SceneValue& child);
  std::string path_of(const std::string& key) const;

  const SceneValue& root_;
  const SceneSource& source_;
  std::map<std::string, std::vector<const SceneValue*>> instances_;  ///< of repeatable tables; null: left out
  std::map<std::string, std::size_t> n_instances_read_;
  std::vector<Problem> problems_;
  std::set<std::string> unsound_;

  // Of every key, whether it was given or not: what it means, and where its value or else its table stands.
  std::map<std::string, std::string> doc_;
  std::map<std::string, Place> place_;

  // The table being read; null if the scene lacks it. `table_known_` are its names, `root_known_` those of the top.
  const SceneValue* table_ = nullptr;
  std::string table_path_;
  bool inside_table_ = false;
  std::vector<std::string> table_known_, root_known_;
};

}  // namespace skein
