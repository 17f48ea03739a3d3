#include <skein/arrays/combination.hpp>
#include <skein/core/error.hpp>
#include <skein/physics/direct_mobility.hpp>
#include <skein/physics/fmm_mobility.hpp>
#include <skein/physics/symmetric_mobility.hpp>

#include "image_sum.hpp"
#include "kernels/node_checks.hpp"
#include "kernels/stokeslet_direct.hpp"

#include <fmt/format.h>

#include <cmath>
#include <utility>

namespace skein {
namespace {

/// First nodes are nodes, also where they are an array of their own.
FmmOptions put_targets_at_sources(FmmOptions options) {
  options.other_targets = FmmTargets::at_sources;
  return options;
}

}  // namespace

SymmetricMobility::SymmetricMobility(std::shared_ptr<const NodeSymmetry> symmetry, std::unique_ptr<Mobility> at_nodes,
                                     std::unique_ptr<Mobility> elsewhere, const double gain)
    : symmetry_(std::move(symmetry)),
      at_nodes_(std::move(at_nodes)),
      elsewhere_(std::move(elsewhere)),
      first_position_("skein::SymmetricMobility::first_position", symmetry_->orbits().n_orbits()),
      first_velocity_("skein::SymmetricMobility::first_velocity", symmetry_->orbits().n_orbits()),
      before_("skein::SymmetricMobility::before", symmetry_->orbits().n_orbits()),
      gain_(gain) {}

SymmetricMobility::SymmetricMobility(const double viscosity, const Precision precision,
                                     std::shared_ptr<const NodeSymmetry> symmetry, SumTeam* team)
    : SymmetricMobility(symmetry, std::make_unique<DirectMobility>(viscosity, precision, KernelPath::automatic, team),
                        std::make_unique<DirectMobility>(viscosity, precision, KernelPath::automatic, team),
                        symmetry->orbits().gain()) {
  if (on_host<ExecSpace> && team == nullptr)
    images_ = std::make_unique<ImageSum>(symmetry_, viscosity,
                                         precision == Precision::automatic ? Precision::in_double : precision);
}

SymmetricMobility::SymmetricMobility(const double viscosity, const FmmOptions& options,
                                     std::shared_ptr<const NodeSymmetry> symmetry, SumTeam* team)
    : SymmetricMobility(symmetry, std::make_unique<FmmMobility>(viscosity, put_targets_at_sources(options), team),
                        std::make_unique<FmmMobility>(viscosity, options, team), std::sqrt(symmetry->orbits().gain())) {
}

SymmetricMobility::~SymmetricMobility() = default;

void SymmetricMobility::add_velocity(const Sources& sources, const ConstVectors& target, const Vectors& velocity) {
  const NodeOrbits& orbits = symmetry_->orbits();
  was_elsewhere_ = !are_same_nodes(sources.position, target) || target.extent_int(0) != orbits.n_nodes;
  if (was_elsewhere_) return elsewhere_->add_velocity(sources, target, velocity);
  SKEIN_REQUIRE(target.extent(0) == sources.force.extent(0) && target.extent(0) == sources.blob.extent(0) &&
                    target.extent(0) == velocity.extent(0),
                "positions, forces, blobs and velocities differ in number");
  pairs_ += static_cast<double>(orbits.n_nodes) * static_cast<double>(orbits.n_nodes);
  symmetry_->take_first(sources.position, first_position_);
  if (!try_images(sources)) compute_at_first_nodes(sources, velocity);
  symmetry_->add_images(first_velocity_, velocity);
}

// Added to what there is already: the fast multipole method judges its error against that, and calls the disturbance of
// fibers at rest in a flow rounding.
void SymmetricMobility::compute_at_first_nodes(const Sources& sources, const ConstVectors& velocity) {
  symmetry_->take_first(velocity, before_);
  Kokkos::deep_copy(ExecSpace(), first_velocity_, before_);
  at_nodes_->add_velocity(sources, first_position_, first_velocity_);
  combine<ExecSpace>(ExecSpace(), first_velocity_, {1.0, first_velocity_}, {-1.0, before_});
}

bool SymmetricMobility::try_images(const Sources& sources) {
  if (images_ == nullptr || !images_->suits(sources)) return false;
  images_->compute(sources, first_position_, first_velocity_);
  return true;
}

/// Where the method turns to direct sums, it has their gain.
double SymmetricMobility::relative_cost(const NodeLines& nodes) const {
  const double of_all_nodes = at_nodes_->relative_cost(nodes);
  return of_all_nodes >= 1.0 ? of_all_nodes / symmetry_->orbits().gain() : of_all_nodes / gain_;
}

std::vector<std::string> SymmetricMobility::take_messages() {
  std::vector<std::string> messages = at_nodes_->take_messages();
  for (std::string& message : elsewhere_->take_messages()) messages.push_back(std::move(message));
  return messages;
}

std::string SymmetricMobility::describe() const {
  if (was_elsewhere_) return elsewhere_->describe();
  const NodeOrbits& orbits = symmetry_->orbits();
  return fmt::format("{}, {}", at_nodes_->describe(),
                     images_ != nullptr ? orbits.describe_images() : orbits.describe_targets());
}

// The sum over first nodes and images, see image_sum.hpp

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
