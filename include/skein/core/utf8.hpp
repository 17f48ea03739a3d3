#pragma once

#include <cstddef>
#include <string_view>

namespace skein {

/// Bytes of the UTF-8 sequence that begins at `at`; 0 if there is none. Overlong forms and surrogates count as none.
std::size_t utf8_sequence_length(std::string_view text, std::size_t at);

/// Where the first byte stands that is no UTF-8; npos if all of the text is.
std::size_t find_utf8_fault(std::string_view text);

}  // namespace skein
