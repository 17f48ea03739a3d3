#pragma once

#include <sys/stat.h>

namespace skein {

/// "a folder", "a pipe" and so on, of what is no regular file; empty for one, and for what is not known.
const char* name_of_kind(mode_t mode);

}  // namespace skein
