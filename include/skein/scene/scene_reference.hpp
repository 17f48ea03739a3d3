#pragma once

#include <string>
#include <vector>

namespace skein {

/// A scene with every key at its default, each explained in a comment.
std::string write_commented_defaults();

/// The reference page of all keys in Markdown.
std::string write_markdown_reference();

/// A key as overrides name it.
struct KeyName {
  std::string path;                ///< "time.method"
  std::vector<std::string> words;  ///< that it may be; empty where it is no choice
  bool is_integer = false;
};

/// Every key there is, in the order of the reference.
std::vector<KeyName> list_keys();

}  // namespace skein
