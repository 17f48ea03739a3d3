#pragma once

#include <filesystem>

namespace skein {

// The only place where files are opened for writing. What stands at a path may have been put there by somebody else:
// symbolic links are not followed, pipes are not waited for, and what was opened is looked at. All return a descriptor
// of a regular file, which programs that are started do not inherit.
//
// @throws Error(cannot_create) where a link, a pipe, a device or a folder is in the way, naming it; Error(io_error)
// with
//         the system's reason otherwise.

/// A new file. What stood at the path, left by a process that was killed, loses its name and is not opened.
int create_file(const std::filesystem::path& path);

/// A file that is continued, or begun where there is none. One that has other names (hard links, as snapshots have) is
/// continued in a copy of its own.
int open_to_append(const std::filesystem::path& path);

/// A file that is read and rewritten while it is locked, begun where there is none.
int open_to_lock(const std::filesystem::path& path);

/// True if the file has names besides the one by which it was opened.
bool has_other_names(int descriptor);

}  // namespace skein
