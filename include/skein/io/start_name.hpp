#pragma once

#include <string>
#include <string_view>

namespace skein {

/// Of the file with the state of another run that a run begins with (start_file.hpp): start-CHECKSUM.checkpoint.
std::string make_start_name(std::string_view checksum);

/// Whether it is such a name, also that of a file half-written, "<name>.partial".
bool is_start_name(std::string_view name);

}  // namespace skein
