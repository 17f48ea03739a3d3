#include <skein/arrays/types.hpp>

#include <string>

namespace skein {

Vectors to_device(const char* label, const std::vector<Vec3>& host) {
  const Vectors device(std::string(label), host.size());
  const auto mirror = Kokkos::create_mirror_view(device);
  for (std::size_t i = 0; i < host.size(); ++i) store(mirror, static_cast<int>(i), host[i]);
  Kokkos::deep_copy(device, mirror);
  return device;
}

Scalars to_device(const char* label, const std::vector<double>& host) {
  const Scalars device(std::string(label), host.size());
  const auto mirror = Kokkos::create_mirror_view(device);
  for (std::size_t i = 0; i < host.size(); ++i) mirror(i) = host[i];
  Kokkos::deep_copy(device, mirror);
  return device;
}

std::vector<Vec3> to_host(const ConstVectors& device) {
  // Some nodes of an array have gaps between their components, which no copy between memories leaps over.
  Vectors packed;
  if (!device.span_is_contiguous()) {
    packed = Vectors("skein::to_host::packed", device.extent(0));
    Kokkos::deep_copy(packed, device);
  }
  const auto mirror =
      Kokkos::create_mirror_view_and_copy(Kokkos::HostSpace(), packed.is_allocated() ? ConstVectors(packed) : device);
  std::vector<Vec3> host(mirror.extent(0));
  for (std::size_t i = 0; i < host.size(); ++i) host[i] = load(mirror, static_cast<int>(i));
  return host;
}

std::vector<double> to_host(const ConstScalars& device) {
  const auto mirror = Kokkos::create_mirror_view_and_copy(Kokkos::HostSpace(), device);
  return {mirror.data(), mirror.data() + mirror.extent(0)};
}

}  // namespace skein
