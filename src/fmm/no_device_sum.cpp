#include <skein/core/error.hpp>

#include "fmm/fmm_paths.hpp"

namespace skein {

// Programs for hosts have no use for the kernels of devices, which take long to compile. Where skein_fmm_device is
// linked, its function is there first, and the linker does not ask the library for this one.
std::unique_ptr<FmmSum> make_device_fmm_sum(Communicator*) {
  throw Error(ExitCode::usage,
              "this program was built for hosts, without the fast multipole method's kernels for devices");
}

}  // namespace skein
