#pragma once

#include <skein/arrays/combination.hpp>
#include <skein/arrays/types.hpp>
#include <skein/core/error.hpp>

#include "kernels/stokeslet_direct.hpp"
#include "kernels/stokeslet_teams.hpp"
#include "tests/reference/point_cloud.hpp"
#include "tests/reference/regularized_stokeslet_reference.hpp"

#include <cstdint>
#include <string>
#include <vector>

namespace skein {

// The direct sums behind one call on host lists, for the tests that all of them pass.

enum class Sum { general, symmetric, rounds, teams };
inline constexpr double test_viscosity = 1.7;

inline std::string name_of(const Sum sum) {
  switch (sum) {
    case Sum::general:
      return "general";
    case Sum::symmetric:
      return "symmetric";
    case Sum::rounds:
      return "rounds";
    case Sum::teams:
      return "teams";
  }
  return "";
}

/// A host array of a list; `to_device` would make one of the default space, which may be a GPU's.
inline HostVectors make_host_vectors(const std::vector<Vec3>& list) {
  const HostVectors vectors("test::vectors", list.size());
  for (std::size_t i = 0; i < list.size(); ++i) store(vectors, static_cast<int>(i), list[i]);
  return vectors;
}

/// `velocity` plus what teams add to it in the memory of a space.
template <class Space>
std::vector<Vec3> add_velocity_by_teams(const Precision precision, const reference::PointForces& sources,
                                        const std::vector<Vec3>& target, const std::vector<Vec3>& velocity,
                                        const TeamSplit& split) {
  const auto copy = [](const std::vector<Vec3>& list) {
    return VectorView<Space>(
        Kokkos::create_mirror_view_and_copy(typename Space::memory_space(), make_host_vectors(list)));
  };
  const HostScalars blob("test::blob", sources.blob.size());
  for (std::size_t i = 0; i < sources.blob.size(); ++i) blob(i) = sources.blob[i];
  const VectorView<Space> result = copy(velocity);
  ScalarView<Space> partial;
  add_stokeslet_velocity_by_teams<Space>(
      Space(), copy(sources.position), copy(sources.force),
      ScalarView<Space>(Kokkos::create_mirror_view_and_copy(typename Space::memory_space(), blob)), copy(target),
      result, test_viscosity, precision, split, partial);
  Kokkos::fence();
  const auto on_host = Kokkos::create_mirror_view_and_copy(Kokkos::HostSpace(), result);
  std::vector<Vec3> list;
  for (int i = 0; i < on_host.extent_int(0); ++i) list.push_back(load(on_host, i));
  return list;
}

/// `velocity` plus what `sum` adds to it; teams do so on the device, if there is one.
inline std::vector<Vec3> add_velocity(const Sum sum, const Precision precision, const reference::PointForces& sources,
                                      const std::vector<Vec3>& target, const std::vector<Vec3>& velocity) {
  if (sum == Sum::teams) return add_velocity_by_teams<ExecSpace>(precision, sources, target, velocity, {.n_runs = 3});
  const HostSpace space;
  const HostVectors position = make_host_vectors(sources.position), force = make_host_vectors(sources.force),
                    result = make_host_vectors(velocity);
  const HostScalars blob("test::blob", sources.blob.size());
  for (std::size_t i = 0; i < sources.blob.size(); ++i) blob(i) = sources.blob[i];
  if (sum == Sum::general)
    add_stokeslet_velocity(space, position, force, blob, make_host_vectors(target), result, test_viscosity, precision);
  if (sum == Sum::symmetric)
    add_symmetric_stokeslet_velocity(space, position, force, blob, result, test_viscosity, precision);
  if (sum == Sum::rounds) {
    const PairRounds rounds(position.extent_int(0));
    const HostVectors added("test::added", result.extent(0));
    std::vector<HostVectors> scratch;
    if (target.size() != velocity.size()) throw Error(ExitCode::internal, "targets and velocities differ in number");
    compute_round_velocity(space, position, force, blob, rounds, {rounds.top_level(), 0}, added, test_viscosity,
                           precision, scratch);
    combine<HostSpace>(space, result, {1.0, result}, {1.0, added});
  }
  space.fence();
  std::vector<Vec3> list;
  for (int i = 0; i < result.extent_int(0); ++i) list.push_back(load(result, i));
  return list;
}

inline std::vector<Vec3> compute_velocity(const Sum sum, const Precision precision,
                                          const reference::PointForces& sources, const std::vector<Vec3>& target) {
  return add_velocity(sum, precision, sources, target, std::vector<Vec3>(target.size()));
}

/// Forces with random blobs, in the proportions of a fiber: blobs of about the distance to the nearest neighbour.
inline reference::PointForces make_sources(const reference::Cloud cloud, const int n_sources, const Vec3 center,
                                           const std::uint64_t seed) {
  reference::Random random(seed);
  const double size = 0.3;
  return {reference::make_cloud(cloud, n_sources, center, size, random),
          reference::make_random_vectors(n_sources, 0.02, random),
          reference::make_random_lengths(n_sources, 0.003, 0.03, random)};
}

/// The same with equal blobs, as the symmetric sum needs them.
inline reference::PointForces make_equal_sources(const reference::Cloud cloud, const int n_sources, const Vec3 center,
                                                 const std::uint64_t seed) {
  reference::PointForces sources = make_sources(cloud, n_sources, center, seed);
  sources.blob.assign(sources.blob.size(), 0.008);
  return sources;
}

}  // namespace skein
