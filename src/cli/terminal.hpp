#pragma once

#include <string>

namespace skein {

/// True if stderr is a terminal that can be rewritten.
bool stderr_is_terminal();

/// Columns of stderr's terminal; 80 if they are not known.
int count_terminal_columns();

/// True if stderr is such a terminal and NO_COLOR (https://no-color.org) does not forbid colour.
bool stderr_has_color();

// All that the program writes to stdout and stderr goes through these, which let no control character of a title, a
// name or a host through (core/terminal_text.hpp).

/// Messages on stderr, "skein: " first; errors in red and warnings in yellow where there is colour.
void print_error(const std::string& message);
void print_warning(const std::string& message);
void print_note(const std::string& message);

/// Lines on stderr that belong to no kind; a line break is added.
void print_message(const std::string& text);

/// What was asked for, on stdout. @throws std::system_error if it cannot be written
void print_result(const std::string& text);

}  // namespace skein
