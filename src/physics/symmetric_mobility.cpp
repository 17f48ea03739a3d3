#include <skein/arrays/combination.hpp>
#include <skein/core/error.hpp>
#include <skein/physics/direct_mobility.hpp>
#include <skein/physics/fmm_mobility.hpp>
#include <skein/physics/symmetric_mobility.hpp>

#include "image_sum.hpp"
#include "kernels/node_checks.hpp"

#include <fmt/format.h>

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
                                     std::unique_ptr<Mobility> elsewhere)
    : symmetry_(std::move(symmetry)),
      at_nodes_(std::move(at_nodes)),
      elsewhere_(std::move(elsewhere)),
      first_position_("skein::SymmetricMobility::first_position", symmetry_->orbits().n_orbits()),
      first_velocity_("skein::SymmetricMobility::first_velocity", symmetry_->orbits().n_orbits()),
      before_("skein::SymmetricMobility::before", symmetry_->orbits().n_orbits()) {}

SymmetricMobility::SymmetricMobility(const double viscosity, const Precision precision,
                                     std::shared_ptr<const NodeSymmetry> symmetry, SumTeam* team)
    : SymmetricMobility(std::move(symmetry),
                        std::make_unique<DirectMobility>(viscosity, precision, KernelPath::automatic, team),
                        std::make_unique<DirectMobility>(viscosity, precision, KernelPath::automatic, team)) {
  if (on_host<ExecSpace> && team == nullptr)
    images_ = std::make_unique<ImageSum>(symmetry_, viscosity,
                                         precision == Precision::automatic ? Precision::in_double : precision);
}

SymmetricMobility::SymmetricMobility(const double viscosity, const FmmOptions& options,
                                     std::shared_ptr<const NodeSymmetry> symmetry, SumTeam* team)
    : SymmetricMobility(std::move(symmetry),
                        std::make_unique<FmmMobility>(viscosity, put_targets_at_sources(options), team),
                        std::make_unique<FmmMobility>(viscosity, options, team)) {}

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

}  // namespace skein
