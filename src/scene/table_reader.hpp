#pragma once

#include "scene_reader.hpp"
#include "scene_value.hpp"

#include <cstdint>
#include <string>
#include <vector>

namespace skein {

/// Takes the keys of a table of a file that is no scene. What is wrong is collected with its place.
class TableReader {
 public:
  /// @param name  "[parameter]"; of the file itself "the top of the file"
  TableReader(const SceneValue& table, std::string name, const SceneSource& source, std::vector<Problem>& problems)
      : table_(table), name_(std::move(name)), source_(source), problems_(problems) {}

  /// Null if it is not there.
  const SceneValue* find(const std::string& key);

  // True if the key is there and right; the value stays as it was otherwise.
  bool read(const std::string& key, std::string& value);
  bool read(const std::string& key, double& value);
  bool read(const std::string& key, std::uint64_t& value);
  /// @param words  of which the value is one. @param chosen  its index
  bool read(const std::string& key, const std::vector<std::string>& words, std::size_t& chosen);

  void refuse(const SceneValue& where, const std::string& message);
  /// For what is missing.
  void refuse(const std::string& message) { refuse(table_, message); }

  /// To be called when all keys were asked for.
  void refuse_unknown();

 private:
  bool check(const SceneValue& value, const std::string& key, bool fits, const std::string& wanted);

  const SceneValue& table_;
  std::string name_;
  const SceneSource& source_;
  std::vector<Problem>& problems_;
  std::vector<std::string> known_;
};

}  // namespace skein
