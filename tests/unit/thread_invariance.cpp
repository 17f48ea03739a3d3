#include <skein/arrays/combination.hpp>
#include <skein/arrays/runtime.hpp>

#include "tests/unit/stokeslet_case.hpp"

#include <algorithm>
#include <cstdio>
#include <vector>

// Prints a hash of every sum's bits, for compare_thread_counts.cmake to compare between numbers of threads. The first
// line says how many threads there were.

namespace skein {
namespace {

/// FNV-1a over bytes.
std::uint64_t hash_of(const void* bytes, const std::size_t n_bytes) {
  std::uint64_t hash = 0xcbf29ce484222325u;
  for (std::size_t i = 0; i < n_bytes; ++i)
    hash = (hash ^ static_cast<const unsigned char*>(bytes)[i]) * 0x100000001b3u;
  return hash;
}

void print_hashes() {
  const int n_threads = HostSpace().concurrency();
  std::printf("threads %d\n", n_threads);
  for (const int n_nodes : {301, 1440, 7000}) {
    const reference::PointForces nodes = make_equal_sources(reference::Cloud::tube, n_nodes, {1.0, -3.0, 0.2}, 17);
    const std::vector<Vec3> rest(nodes.position.size());
    for (const Sum sum : {Sum::general, Sum::symmetric, Sum::teams})
      for (const Precision precision : {Precision::in_double, Precision::in_single}) {
        if (n_nodes > 2000 && sum != Sum::symmetric) continue;  // only there does a large sum take another path
        // Barriers and ranks of a team matter only where it has several threads.
        const int team_size = std::min(n_threads, 2);
        const auto velocity =
            sum == Sum::teams ? add_velocity_by_teams<ExecSpace>(precision, nodes, nodes.position, rest, {3, team_size})
                              : compute_velocity(sum, precision, nodes, nodes.position);
        std::printf("%s %s %d %016llx\n", name_of(sum).c_str(), precision == Precision::in_double ? "double" : "single",
                    n_nodes, static_cast<unsigned long long>(hash_of(velocity.data(), velocity.size() * sizeof(Vec3))));
      }
    const HostVectors position = make_host_vectors(nodes.position), force = make_host_vectors(nodes.force);
    const double dot = dot_product<HostSpace>(HostSpace(), position, force);
    std::printf("dot_product %d %016llx\n", n_nodes, static_cast<unsigned long long>(hash_of(&dot, sizeof dot)));
  }
}

}  // namespace
}  // namespace skein

int main() {
  const skein::Runtime runtime;
  skein::print_hashes();
}
