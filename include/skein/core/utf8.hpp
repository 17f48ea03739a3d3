#pragma once

#include <cstddef>
#include <string_view>

namespace skein {

struct Utf8Character {
  std::size_t n_bytes = 0;  ///< 0: there is none; overlong forms and surrogates count as none
  char32_t code = 0;
};

/// The character that begins at `at`.
Utf8Character read_utf8(std::string_view text, std::size_t at);

/// Where the first byte stands that is no UTF-8; npos if all of the text is.
std::size_t find_utf8_fault(std::string_view text);

/// True for characters that are not shown but do something to what is: control characters (C0, DEL, C1; the line break
/// among them), separators of lines and paragraphs, and marks that change the direction of writing.
bool is_control_character(char32_t code);

}  // namespace skein
