#pragma once

#include <skein/core/error.hpp>

#include <string>
#include <vector>

namespace skein {

/// Where something in a scene was written: in a file, or in a --set of the command line.
struct Origin {
  std::string source;        ///< the file's name, or "--set key=value"
  int line = 0, column = 0;  ///< from 1; 0 in a --set
  int override_index = -1;   ///< which --set, from 0; -1 in a file
};

/// One thing that is wrong with a scene, or only suspicious (a warning).
struct Problem {
  Origin where;
  std::string message;  ///< one line
  std::string key_doc;  ///< what the key concerned means; empty where there is none

  /// "file:line:column: message", and the key's doc on an indented second line.
  std::string describe() const;
};

/// In the order in which a reader meets them: by line and column, then by --set. Repetitions are dropped.
void sort_problems(std::vector<Problem>& problems);

/// describe() of each on lines of their own; of a great many only the first.
std::string describe_problems(const std::vector<Problem>& problems);

/// All that is wrong with a scene, or with a file about scenes, at once. what() is a heading and describe_problems().
class SceneError : public Error {
 public:
  /// @param kind  of the file, as the heading calls it
  SceneError(const std::string& file, std::vector<Problem> problems, const std::string& kind = "scene");
  const std::vector<Problem>& problems() const { return problems_; }

 private:
  std::vector<Problem> problems_;
};

}  // namespace skein
