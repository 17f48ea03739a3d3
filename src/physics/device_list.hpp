#pragma once

#include <skein/arrays/types.hpp>

#include <algorithm>
#include <string>
#include <vector>

namespace skein {

/// A list of anything plain, copied to the device.
template <class Value>
Kokkos::View<Value*, ExecSpace> copy_to_device(const char* label, const std::vector<Value>& values) {
  const Kokkos::View<Value*, ExecSpace> device(std::string(label), values.size());
  const auto mirror = Kokkos::create_mirror_view(device);
  std::copy(values.begin(), values.end(), mirror.data());
  Kokkos::deep_copy(device, mirror);
  return device;
}

}  // namespace skein
