#pragma once

#include <skein/fmm/fmm_sum.hpp>

#include <memory>

namespace skein {

/// The sum on the host, with its vector units. @param ranks  that share it; null: none
std::unique_ptr<FmmSum> make_host_fmm_sum(Communicator* ranks);

/// The sum by plain kernels in the execution space. @param ranks  that share it, each on its own device; null: none
/// @throws Error(usage) in a program for hosts that does not link skein_fmm_device, as tests and benches do
std::unique_ptr<FmmSum> make_device_fmm_sum(Communicator* ranks);

}  // namespace skein
