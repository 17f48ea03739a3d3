#pragma once

#include <string>

namespace skein {

/// A scene with every key at its default, each explained in a comment.
std::string write_commented_defaults();

/// The reference page of all keys in Markdown.
std::string write_markdown_reference();

}  // namespace skein
