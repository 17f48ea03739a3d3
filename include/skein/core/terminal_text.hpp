#pragma once

#include <string>
#include <string_view>

namespace skein {

/// A text as it may be shown on a terminal, wherever its parts come from: titles, names of files and hosts, and keys of
/// a scene can hold what moves the cursor, sets the terminal's title, or turns the direction of writing. Control
/// characters and such marks become `\x1b` or `\u202e`, bytes of no UTF-8 `\xff`. Line breaks and tabulators
/// stay.
std::string make_terminal_text(std::string_view text);

/// The same for a part that has to stay on one line: line breaks and tabulators are written as `\x0a` and `\x09`.
std::string make_terminal_line(std::string_view text);

}  // namespace skein
