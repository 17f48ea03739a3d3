#include "local_file_system.hpp"

#include <sys/vfs.h>

#include <algorithm>
#include <array>

namespace skein {

bool is_local_type(const std::uint64_t type) {
  // From linux/magic.h and the file systems' own headers.
  constexpr std::array<std::uint64_t, 11> local = {
      0xef53,      // ext2, ext3, ext4
      0x58465342,  // XFS
      0x9123683e,  // Btrfs
      0x01021994,  // tmpfs
      0x858458f6,  // ramfs
      0x794c7630,  // overlayfs, of containers
      0x2fc12fc1,  // ZFS
      0xf2f52010,  // F2FS
      0xca451a4e,  // bcachefs
      0x3153464a,  // JFS
      0x52654973,  // ReiserFS
  };
  return std::find(local.begin(), local.end(), type) != local.end();
}

bool is_on_local_file_system(const int descriptor) {
  struct statfs status {};
  // The type is a signed number of 32 or 64 bits, by architecture.
  return ::fstatfs(descriptor, &status) == 0 && is_local_type(static_cast<std::uint32_t>(status.f_type));
}

}  // namespace skein
