#include <skein/arrays/launch.hpp>
#include <skein/physics/chain.hpp>
#include <skein/physics/direct_mobility.hpp>
#include <skein/physics/fmm_mobility.hpp>
#include <skein/physics/mobility_choice.hpp>
#include <skein/physics/physics.hpp>
#include <skein/physics/symmetric_mobility.hpp>

#include "force_share.hpp"
#include "force_table.hpp"
#include "motion_times.hpp"

#include <algorithm>
#include <cmath>
#include <span>
#include <utility>

namespace skein {
namespace {

/// Null for a scene that has none. @throws Error(scene_error) where its fibers lack it
std::shared_ptr<const NodeSymmetry> make_symmetry(const SceneConfig& scene, const std::vector<Fiber>& fibers) {
  if (scene.symmetry.is_none()) return nullptr;
  return std::make_shared<const NodeSymmetry>(
      make_node_orbits(scene.symmetry, fibers, make_surface_nodes(fibers, scene.seed)));
}

/// The mobility a scene asks for.
std::unique_ptr<Mobility> make_mobility(const SceneConfig& scene, const std::shared_ptr<const NodeSymmetry>& symmetry,
                                        SumTeam* team) {
  const MobilityChoice choice = choose_mobility(scene);
  const double viscosity = scene.fluid.viscosity;
  if (symmetry != nullptr && choice.is_direct)
    return std::make_unique<SymmetricMobility>(viscosity, choice.precision, symmetry, team);
  if (symmetry != nullptr) return std::make_unique<SymmetricMobility>(viscosity, choice.fmm, symmetry, team);
  if (choice.is_direct)
    return std::make_unique<DirectMobility>(viscosity, choice.precision, KernelPath::automatic, team);
  return std::make_unique<FmmMobility>(viscosity, choice.fmm, team);
}

}  // namespace

void Force::add_energies(const double time, const ConstVectors& position, std::vector<double>& energy) const {
  seek_measures(time, position);
  wait_for(ExecSpace());
  add_found_energies(energy);
}

double Force::compute_largest_strain(const ConstVectors& position) const {
  seek_measures(0.0, position);
  wait_for(ExecSpace());
  return found_largest_strain();
}

void Force::add_moments(const std::vector<Fiber>& fibers, const double time, const ConstVectors& position,
                        std::vector<SymmetricTensor>& moment) const {
  const Vectors force("skein::Force::moment", position.extent(0));
  add_forces(time, position, force);
  const std::vector<Vec3> x = to_host(position), f = to_host(ConstVectors(force));
  for (std::size_t i = 0; i < fibers.size(); ++i) {
    const auto first = static_cast<std::size_t>(fibers[i].first_node),
               n = static_cast<std::size_t>(fibers[i].n_nodes());
    const SymmetricTensor part =
        compute_symmetric_moment(std::span(x).subspan(first, n), std::span(f).subspan(first, n));
    for (std::size_t c = 0; c < part.size(); ++c) moment[i][c] += part[c];
  }
}

ForceList make_forces(const SceneConfig& scene, const std::vector<Fiber>& fibers) {
  ForceList forces;
  for (const auto append : {append_springs, append_bending, append_shear_couple, append_repulsion, append_gravity,
                            append_tethers, append_torques, append_undulations, append_clamps})
    append(scene, fibers, forces);
  return forces;
}

void Physics::compute_forces(const double time, const ConstVectors& position, const Vectors& force) const {
  if (shared_forces != nullptr && shared_forces->compute(forces, time, position, {}, force)) return;
  if (forces.empty()) return Kokkos::deep_copy(ExecSpace(), force, 0.0);
  forces.front()->compute_forces(time, position, force);
  for (std::size_t i = 1; i < forces.size(); ++i) forces[i]->add_forces(time, position, force);
}

void Physics::compute_force_changes(const double time, const ConstVectors& position, const ConstVectors& displacement,
                                    const Vectors& change) const {
  if (shared_forces != nullptr && shared_forces->compute(forces, time, position, displacement, change)) return;
  Kokkos::deep_copy(ExecSpace(), change, 0.0);
  for (const auto& part : forces) part->add_force_changes(time, position, displacement, change);
}

std::vector<double> Physics::compute_energies(const double time, const ConstVectors& position) const {
  for (const auto& part : forces) part->seek_measures(time, position);
  wait_for(ExecSpace());
  return found_energies();
}

std::vector<double> Physics::found_energies() const {
  std::vector<double> energy(fibers.size());
  for (const auto& part : forces) part->add_found_energies(energy);
  return energy;
}

StepMeasures Physics::measure(const double time, const ConstVectors& position) const {
  sections.seek(position);
  for (const auto& part : forces) part->seek_measures(time, position);
  wait_for(ExecSpace());
  StepMeasures measures{sections.found(), found_energies()};
  for (const auto& part : forces)
    measures.largest_strain = std::max(measures.largest_strain, part->found_largest_strain());
  return measures;
}

bool Physics::has_force_between_fibers() const {
  return std::any_of(forces.begin(), forces.end(),
                     [](const auto& part) { return part->promises().acts_between_fibers; });
}

double Physics::time_scale() const {
  double scale = flow->time_scale();
  for (const auto& part : forces) scale = std::min(scale, part->time_scale());
  return std::isfinite(scale) ? scale : find_relaxation_time(fibers, viscosity);
}

double Physics::relative_sum_cost() const {
  NodeLines nodes;
  for (const Fiber& fiber : fibers) {
    nodes.n_nodes += fiber.n_nodes();
    nodes.length += fiber.length();
    nodes.max_blob = std::max(nodes.max_blob, fiber.config.blob);
  }
  return mobility->relative_cost(nodes);
}

TimeCourse Physics::make_time_course() const {
  TimeCourse course;
  flow->add_course(course);
  for (const auto& part : forces) part->add_course(course);
  return course;
}

std::string Physics::describe_forces() const {
  std::string text;
  for (std::size_t i = 1; i < forces.size(); ++i) text += (text.empty() ? "" : "; ") + forces[i]->describe();
  return text;
}

std::vector<Vec3> Physics::make_start_nodes(const std::uint64_t seed) const {
  std::vector<Vec3> nodes = make_surface_nodes(fibers, seed);
  if (symmetry != nullptr) make_symmetric(symmetry->orbits(), fibers, nodes);
  return nodes;
}

Physics make_physics(const SceneConfig& asked, SumTeam* team) {
  const SceneConfig scene = resolve_chains(asked);
  std::vector<Fiber> fibers = make_fibers(scene.fibers);
  RigidBodies rigid_bodies(fibers, scene.fluid.viscosity);
  std::shared_ptr<const NodeSymmetry> symmetry = make_symmetry(scene, fibers);
  Sections sections(fibers);
  Scalars blob = to_device("skein::Physics::blob", make_blobs(fibers));
  std::vector<std::unique_ptr<Force>> forces = make_forces(scene, fibers);
  std::shared_ptr<SharedForces> shared_forces = team == nullptr ? nullptr : team->share_forces(scene, fibers, forces);
  std::unique_ptr<BackgroundFlow> flow = make_background_flow(scene.flows);
  std::shared_ptr<SharedNodes> shared_nodes = team == nullptr ? nullptr : team->share_nodes(shared_forces, *flow);
  return {.fibers = std::move(fibers),
          .forces = std::move(forces),
          .flow = std::move(flow),
          .mobility = make_mobility(scene, symmetry, team),
          .rigid_bodies = std::move(rigid_bodies),
          .sections = std::move(sections),
          .blob = blob,
          .viscosity = scene.fluid.viscosity,
          .symmetry = std::move(symmetry),
          .shared_forces = std::move(shared_forces),
          .shared_nodes = std::move(shared_nodes)};
}

}  // namespace skein
