#include "physics/image_sum.hpp"

#include "kernels/node_checks.hpp"
#include "kernels/stokeslet_direct.hpp"

#include <utility>

namespace skein {

SymmetricMobility::ImageSum::ImageSum(std::shared_ptr<const NodeSymmetry> symmetry, const double viscosity,
                                      const Precision precision)
    : symmetry_(std::move(symmetry)), viscosity_(viscosity), precision_(precision) {
  const NodeOrbits& orbits = symmetry_->orbits();
  const auto n_orbits = static_cast<std::size_t>(orbits.n_orbits());
  const std::size_t n_copies = orbits.group.size() * n_orbits;
  matches_ = make_image_matches(orbits.group, orbits.classes);
  share_ = HostScalars("skein::ImageSum::share", n_orbits);
  position_ = HostVectors("skein::ImageSum::position", n_copies);
  force_ = HostVectors("skein::ImageSum::force", n_copies);
  velocity_ = HostVectors("skein::ImageSum::velocity", n_copies);
  blob_ = HostScalars("skein::ImageSum::blob", n_copies);
  for (const OrbitClass& run : orbits.classes)
    for (int orbit = run.first; orbit < run.first + run.count; ++orbit)
      share_(orbit) = 1.0 / static_cast<double>(run.stabilizer.size());
}

bool SymmetricMobility::ImageSum::suits(const Sources& sources) const {
  if (symmetry_->orbits().n_nodes < min_symmetric_nodes) return false;
  const BlobRange blobs = find_blob_range<ExecSpace>(ExecSpace(), sources.blob);
  return blobs.smallest == blobs.largest;
}

void SymmetricMobility::ImageSum::compute(const Sources& sources, const ConstVectors& first_position,
                                          const Vectors& first_velocity) {
  compute_on_host(ExecSpace(), sources, first_position, first_velocity);
}

template <class Space>
void SymmetricMobility::ImageSum::compute_on_host(const Space& space, const Sources& sources,
                                                  const ConstVectors& first_position, const Vectors& first_velocity) {
  if constexpr (on_host<Space>) {
    symmetry_->take_first(sources.force, first_velocity);
    fill(space, first_position, first_velocity);
    Kokkos::deep_copy(blob_, find_blob_range<Space>(space, sources.blob).largest);
    Kokkos::deep_copy(velocity_, 0.0);
    add_image_stokeslet_velocity(space, matches_, position_, force_, blob_, velocity_, viscosity_, precision_);
    fold(space, first_velocity);
  }
}

template <class Space>
void SymmetricMobility::ImageSum::fill(const Space& space, const ConstVectorView<Space>& first_position,
                                       const ConstVectorView<Space>& first_force) {
  Kokkos::parallel_for("skein::ImageSum::fill", Kokkos::RangePolicy<Space>(space, 0, matches_.n_orbits),
                       [&](const int orbit) {
                         const Vec3 x = load(first_position, orbit), f = share_(orbit) * load(first_force, orbit);
                         int copy = orbit;
                         for (const SignMatrix element : symmetry_->orbits().group) {
                           store(position_, copy, element * x);
                           store(force_, copy, element * f);
                           copy += matches_.n_orbits;
                         }
                       });
}

/// The velocities of all copies, mapped back.
template <class Space>
void SymmetricMobility::ImageSum::fold(const Space& space, const VectorView<Space>& first_velocity) const {
  Kokkos::parallel_for("skein::ImageSum::fold", Kokkos::RangePolicy<Space>(space, 0, matches_.n_orbits),
                       [&](const int orbit) {
                         Vec3 sum;
                         int copy = orbit;
                         for (const SignMatrix element : symmetry_->orbits().group) {
                           sum = sum + element * load(velocity_, copy);
                           copy += matches_.n_orbits;
                         }
                         store(first_velocity, orbit, sum);
                       });
}

}  // namespace skein
