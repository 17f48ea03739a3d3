#pragma once

#include <skein/core/kernel_path.hpp>

namespace skein {

/// Where this build's kernels run, for sources that do not see Kokkos: host or device.
KernelPath default_path();

}  // namespace skein
