#pragma once

#include <skein/arrays/portable.hpp>
#include <skein/core/vec3.hpp>

#include <type_traits>
#include <vector>

namespace skein {

/// Device array of 3-vectors, shape [n, 3]. LayoutLeft on every backend: x, y and z are contiguous, so that CPU loops
/// vectorize and GPU loads coalesce.
/// type_identity: a call deduces its space from its execution-space argument alone, so any assignable View is accepted
/// and a wrong one is reported by its type instead of by a failed template.
template <class Space>
using VectorView = std::type_identity_t<Kokkos::View<double* [3], Kokkos::LayoutLeft, Space>>;
template <class Space>
using ConstVectorView = std::type_identity_t<Kokkos::View<const double* [3], Kokkos::LayoutLeft, Space>>;
template <class Space>
using ScalarView = std::type_identity_t<Kokkos::View<double*, Kokkos::LayoutLeft, Space>>;
template <class Space>
using ConstScalarView = std::type_identity_t<Kokkos::View<const double*, Kokkos::LayoutLeft, Space>>;

using ExecSpace = Kokkos::DefaultExecutionSpace;
using HostSpace = Kokkos::DefaultHostExecutionSpace;

/// What kernels leave for the host, which has it after the next wait for the device: an integer, a number, some of
/// them.
using FoundNumber = Kokkos::View<int, SharedHostMemory>;
using FoundNumbers = Kokkos::View<int*, SharedHostMemory>;
using FoundReal = Kokkos::View<double, SharedHostMemory>;
using FoundReals = Kokkos::View<double*, SharedHostMemory>;

using Vectors = VectorView<ExecSpace>;
using ConstVectors = ConstVectorView<ExecSpace>;
using Scalars = ScalarView<ExecSpace>;
using ConstScalars = ConstScalarView<ExecSpace>;
using HostVectors = VectorView<HostSpace>;
using HostScalars = ScalarView<HostSpace>;

/// True where kernels run on the host: they may then use CPU vector types and raw pointers.
template <class Space>
inline constexpr bool on_host = std::is_same_v<typename Space::memory_space, Kokkos::HostSpace>;

template <class View>
KOKKOS_INLINE_FUNCTION Vec3 load(const View& v, const int i) {
  return {v(i, 0), v(i, 1), v(i, 2)};
}
template <class View>
KOKKOS_INLINE_FUNCTION void store(const View& v, const int i, const Vec3 a) {
  v(i, 0) = a.x;
  v(i, 1) = a.y;
  v(i, 2) = a.z;
}

/// Copies between host lists and device arrays; the label names the device array.
Vectors to_device(const char* label, const std::vector<Vec3>& host);
Scalars to_device(const char* label, const std::vector<double>& host);
std::vector<Vec3> to_host(const ConstVectors& device);
std::vector<double> to_host(const ConstScalars& device);

}  // namespace skein

/// Calls X(space) for every execution space the kernels are compiled for.
#if defined(KOKKOS_ENABLE_CUDA) || defined(KOKKOS_ENABLE_HIP)
#define SKEIN_FOR_EACH_EXEC_SPACE(X) X(Kokkos::DefaultHostExecutionSpace) X(Kokkos::DefaultExecutionSpace)
#else
#define SKEIN_FOR_EACH_EXEC_SPACE(X) X(Kokkos::DefaultExecutionSpace)
#endif
