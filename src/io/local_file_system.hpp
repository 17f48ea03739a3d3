#pragma once

#include <cstdint>

namespace skein {

/// True for the types (statfs(2), f_type) of file systems that belong to one machine: on these a lock that the system
/// grants proves that nobody else holds it. False for all that may be shared (NFS, Lustre, FUSE, ...) or is not known.
bool is_local_type(std::uint64_t type);

bool is_on_local_file_system(int descriptor);

}  // namespace skein
