#pragma once

namespace skein {

/// Where arrays and loops are.
enum class KernelPath {
  automatic,  ///< on the host where kernels run there, else on the device
  host,       ///< the processor's vector units; where arrays of a device may be copied to
  device,     ///< plain kernels in the execution space; the far sum has none in programs for hosts
};

}  // namespace skein
