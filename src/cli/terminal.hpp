#pragma once

#include <string>

namespace skein {

/// True if stderr is a terminal that can be rewritten.
bool stderr_is_terminal();

/// Columns of stderr's terminal; 80 if they are not known.
int count_terminal_columns();

/// True if stderr is such a terminal and NO_COLOR (https://no-color.org) does not forbid colour.
bool stderr_has_color();

/// Messages on stderr, "skein: " first; errors in red and warnings in yellow where there is colour.
void print_error(const std::string& message);
void print_warning(const std::string& message);

}  // namespace skein
