#pragma once

#include <skein/scene/scene_config.hpp>
#include <skein/scene/words.hpp>

#include <cstdint>
#include <string>
#include <vector>

namespace skein {

/// What a number may be. Bounds are included.
struct Range {
  double low, high;
  std::string text;  ///< "above 0"; empty for any number
};

/// A key as scenes and the reference show it.
struct Key {
  std::string name;
  std::string unit;     ///< empty: a pure number or no number
  Range range;          ///< of numbers, and of each component of a vector
  std::string meaning;  ///< half a sentence, in lower case
};

/// A table of the scene. The top of the file has an empty name.
struct Table {
  std::string name;
  bool repeatable;  ///< [[name]], once per instance
  std::string meaning;
  std::size_t n_instances = 1;
  bool is_absent_by_default = false;
};

/// Sees every key of a scene in order. What reads, writes and documents scenes are visitors, so that a key is declared
/// once, in scene_keys.cpp or, of a table of which there may be several, in repeatable_tables.cpp.
class KeyVisitor {
 public:
  virtual ~KeyVisitor() = default;

  virtual void begin_table(const Table& table) = 0;
  virtual void end_table() = 0;
  virtual void text(const Key& key, std::string& value) = 0;
  virtual void choice(const Key& key, const std::vector<Choice>& choices, std::size_t& chosen) = 0;
  virtual void integer(const Key& key, std::int64_t& value) = 0;
  virtual void number(const Key& key, double& value) = 0;
  virtual void vector(const Key& key, Vec3& value) = 0;
  virtual void profile(const Key& key, std::vector<ProfilePoint>& value) = 0;
  virtual void numbers(const Key& key, std::vector<double>& value) = 0;  ///< a list, which may be empty

  /// The enumerator that a word stands for.
  template <class Enum>
  void choice(const Key& key, const Words<Enum>& words, Enum& value) {
    std::size_t chosen = words.index_of(value);
    choice(key, words.choices(), chosen);
    value = words.value_at(chosen);
  }

  /// Any other integer type; the key's range keeps the value inside it.
  template <class Integer>
  void integer(const Key& key, Integer& value) {
    auto wide = static_cast<std::int64_t>(value);
    integer(key, wide);
    value = static_cast<Integer>(wide);
  }
};

/// Shows the visitor every table and key of a scene, repeatable tables once per instance.
void visit_keys(KeyVisitor& visitor, SceneConfig& scene);

/// "blob: what it means; unit; range; default", one line. `path` is the key's name with its table.
std::string describe_key(const std::string& path, const Key& key, const std::string& default_value);

/// "[0.0, 1.0, 0.0]"
std::string format_vector(const Vec3& vector);

/// "[[0.0, 1.0], [1.0, 1.0]]"
std::string format_profile(const std::vector<ProfilePoint>& profile);

/// "[12.0, 14.0]"
std::string format_numbers(const std::vector<double>& numbers);

}  // namespace skein
