#include <skein/core/error.hpp>
#include <skein/physics/mobility_choice.hpp>
#include <skein/physics/symmetric_mobility.hpp>

#include "kernels/node_checks.hpp"
#include "kernels/stokeslet_direct.hpp"
#include "kernels/stokeslet_images.hpp"

#include <fmt/format.h>

#include <utility>

namespace skein {

/// What the host's sum over images needs. Arrays are [n_elements * n_orbits], see ImageMatches.
struct SymmetricMobility::Copies {
  explicit Copies(const NodeOrbits& orbits)
      : matches(make_image_matches(orbits.group, orbits.classes)),
        share("skein::SymmetricMobility::share", static_cast<std::size_t>(orbits.n_orbits())) {
    const std::size_t n = orbits.group.size() * share.extent(0);
    position = HostVectors("skein::SymmetricMobility::position", n);
    force = HostVectors("skein::SymmetricMobility::force", n);
    velocity = HostVectors("skein::SymmetricMobility::velocity", n);
    blob = HostScalars("skein::SymmetricMobility::blob", n);
    for (const OrbitClass& run : orbits.classes)
      for (int orbit = run.first; orbit < run.first + run.count; ++orbit)
        share(orbit) = 1.0 / static_cast<double>(run.stabilizer.size());
  }

  /// @param first_force  [n_orbits, 3]
  void fill(const HostSpace& space, const std::vector<SignMatrix>& group,
            const ConstVectorView<HostSpace>& first_position, const ConstVectorView<HostSpace>& first_force,
            const double blob_of_all) {
    const int n_orbits = share.extent_int(0);
    Kokkos::parallel_for("skein::SymmetricMobility::fill", Kokkos::RangePolicy<HostSpace>(space, 0, n_orbits),
                         [&](const int orbit) {
                           const Vec3 x = load(first_position, orbit);
                           const Vec3 f = share(orbit) * load(first_force, orbit);
                           int copy = orbit;
                           for (const SignMatrix element : group) {
                             store(position, copy, element * x);
                             store(force, copy, element * f);
                             copy += n_orbits;
                           }
                         });
    Kokkos::deep_copy(blob, blob_of_all);
    Kokkos::deep_copy(velocity, 0.0);
  }

  /// The velocities of first nodes: those of all copies, mapped back.
  void fold(const HostSpace& space, const std::vector<SignMatrix>& group,
            const VectorView<HostSpace>& first_velocity) const {
    const int n_orbits = share.extent_int(0);
    Kokkos::parallel_for("skein::SymmetricMobility::fold", Kokkos::RangePolicy<HostSpace>(space, 0, n_orbits),
                         [&](const int orbit) {
                           Vec3 sum;
                           int copy = orbit;
                           for (const SignMatrix element : group) {
                             sum = sum + element * load(velocity, copy);
                             copy += n_orbits;
                           }
                           store(first_velocity, orbit, sum);
                         });
  }

  ImageMatches matches;
  HostScalars share;  ///< [n_orbits]: one over the number of elements that keep a node in place
  HostVectors position, force, velocity;
  HostScalars blob;
};

SymmetricMobility::SymmetricMobility(const double viscosity, const Precision precision,
                                     std::shared_ptr<const NodeSymmetry> symmetry)
    : viscosity_(viscosity),
      precision_(precision == Precision::automatic ? Precision::in_double : precision),
      symmetry_(std::move(symmetry)),
      direct_(viscosity, precision),
      first_position_("skein::SymmetricMobility::first_position", symmetry_->orbits().n_orbits()),
      first_velocity_("skein::SymmetricMobility::first_velocity", symmetry_->orbits().n_orbits()) {
  if (on_host<ExecSpace> && symmetry_->orbits().n_orbits() > 0) copies_ = std::make_unique<Copies>(symmetry_->orbits());
}

SymmetricMobility::~SymmetricMobility() = default;

template <class Space>
bool SymmetricMobility::try_images(const Space& space, const Sources& sources) {
  if constexpr (on_host<Space>) {
    const NodeOrbits& orbits = symmetry_->orbits();
    if (orbits.n_nodes < min_symmetric_nodes) return false;
    const BlobRange blobs = find_blob_range<Space>(space, sources.blob);
    if (blobs.smallest != blobs.largest) return false;
    symmetry_->take_first(sources.force, first_velocity_);
    copies_->fill(space, orbits.group, first_position_, first_velocity_, blobs.largest);
    add_image_stokeslet_velocity(space, copies_->matches, copies_->position, copies_->force, copies_->blob,
                                 copies_->velocity, viscosity_, precision_);
    copies_->fold(space, orbits.group, first_velocity_);
    return true;
  } else {
    return false;
  }
}

void SymmetricMobility::add_velocity(const Sources& sources, const ConstVectors& target, const Vectors& velocity) {
  const NodeOrbits& orbits = symmetry_->orbits();
  if (!are_same_nodes(sources.position, target) || target.extent_int(0) != orbits.n_nodes)
    return direct_.add_velocity(sources, target, velocity);
  SKEIN_REQUIRE(target.extent(0) == sources.force.extent(0) && target.extent(0) == sources.blob.extent(0) &&
                    target.extent(0) == velocity.extent(0),
                "positions, forces, blobs and velocities differ in number");
  pairs_ += static_cast<double>(orbits.n_nodes) * static_cast<double>(orbits.n_nodes);
  symmetry_->take_first(sources.position, first_position_);
  if (!try_images(ExecSpace(), sources)) {
    Kokkos::deep_copy(ExecSpace(), first_velocity_, 0.0);
    add_stokeslet_velocity<ExecSpace>(ExecSpace(), sources.position, sources.force, sources.blob, first_position_,
                                      first_velocity_, viscosity_, precision_);
  }
  symmetry_->add_images(first_velocity_, velocity);
}

std::string SymmetricMobility::describe() const {
  return fmt::format("{}, by {}", describe_direct_sum(precision_), symmetry_->orbits().describe());
}

}  // namespace skein
