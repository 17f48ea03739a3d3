#include <skein/arrays/runtime.hpp>
#include <skein/physics/fmm_mobility.hpp>

#include "tests/reference/point_cloud.hpp"

#include <cstdint>
#include <cstdio>
#include <vector>

// Prints a hash of every velocity's bits, for compare_thread_counts.cmake. The first line says how many threads there
// were.

namespace skein {
namespace {

/// FNV-1a over bytes.
std::uint64_t hash_of(const std::vector<Vec3>& velocity) {
  std::uint64_t hash = 0xcbf29ce484222325u;
  const auto* bytes = reinterpret_cast<const unsigned char*>(velocity.data());
  for (std::size_t i = 0; i < velocity.size() * sizeof(Vec3); ++i) hash = (hash ^ bytes[i]) * 0x100000001b3u;
  return hash;
}

void print_hashes(const KernelPath path, const std::vector<reference::Cloud>& clouds, const int n_many) {
  for (const reference::Cloud cloud : clouds)
    for (const int n : {500, n_many})
      for (const Precision precision : {Precision::in_double, Precision::in_single})
        for (const FarField far_field : {FarField::harmonic, FarField::stokeslet}) {
          if (far_field == FarField::stokeslet && n > 500) continue;
          for (const double largest_blob : {1e-3, 1e-5}) {  // many blobs, and one
            reference::Random random(4);
            const Vectors position =
                to_device("position", reference::make_cloud(cloud, n, {0.3, 0.1, 2.0}, 1.0, random));
            const Sources sources{position, to_device("force", reference::make_random_vectors(n, 1.3, random)),
                                  to_device("blob", reference::make_random_lengths(n, 1e-5, largest_blob, random))};
            FmmOptions options;
            options.path = path;
            options.precision = precision;
            options.far_field = far_field;
            options.tolerance = 1e-3;
            options.leaf_size = 25;
            FmmMobility fmm(1.7, options);
            for (int repeat = 0; repeat < 2; ++repeat) {  // kept operators and buffers change nothing
              const Vectors velocity("velocity", n);
              fmm.add_velocity(sources, position, velocity);
              std::printf("%s %d %d %d %g %016llx\n", reference::name_of(cloud).c_str(), n, static_cast<int>(precision),
                          static_cast<int>(far_field), largest_blob,
                          static_cast<unsigned long long>(hash_of(to_host(velocity))));
            }
          }
        }
}

/// The same with the blobs' term of eps^4 between boxes, which moments carry.
void print_tail_hashes(const KernelPath path, const reference::Cloud cloud, const int n) {
  for (const Precision precision : {Precision::in_double, Precision::in_single}) {
    reference::Random random(5);
    const Vectors position = to_device("position", reference::make_cloud(cloud, n, {0.3, 0.1, 2.0}, 1.0, random));
    const Sources sources{position, to_device("force", reference::make_random_vectors(n, 1.3, random)),
                          to_device("blob", reference::make_random_lengths(n, 1e-3, 1e-2, random))};
    FmmOptions options;
    options.path = path;
    options.precision = precision;
    options.tolerance = 1e-3;
    options.leaf_size = 25;
    options.tail_degree = 4;
    FmmMobility fmm(1.7, options);
    const Vectors velocity("velocity", n);
    fmm.add_velocity(sources, position, velocity);
    std::printf("tail %s %d %d %016llx\n", reference::name_of(cloud).c_str(), n, static_cast<int>(precision),
                static_cast<unsigned long long>(hash_of(to_host(velocity))));
  }
}

}  // namespace
}  // namespace skein

int main() {
  const skein::Runtime runtime;
  std::printf("threads %d\n", skein::HostSpace().concurrency());
  using skein::reference::Cloud;
  skein::print_hashes(skein::KernelPath::host, {Cloud::cube, Cloud::tube, Cloud::line, Cloud::cluster}, 20000);
  skein::print_hashes(skein::KernelPath::device, {Cloud::tube, Cloud::cluster}, 3000);
  for (const Cloud cloud : {Cloud::cube, Cloud::cluster}) {
    skein::print_tail_hashes(skein::KernelPath::host, cloud, 8000);
    skein::print_tail_hashes(skein::KernelPath::device, cloud, 2000);
  }
}
