#include "force_share.hpp"

#include <skein/physics/chain.hpp>
#include <skein/scene/scene_file.hpp>

#include "node_parts.hpp"

#include <algorithm>
#include <utility>

namespace skein {
namespace {

/// Of a section's springs, which each node has with about all nodes in reach.
double count_springs(const FiberConfig& fiber) {
  return static_cast<double>(fiber.nodes_per_section) * fiber.nodes_per_section * (1 + 2 * fiber.reach_along);
}

}  // namespace

NeededRows find_needed_rows(const std::vector<Fiber>& fibers, const ForceList& forces, const RankParts& owners) {
  int reach = 0;
  bool sees_centroids = false;
  for (const auto& force : forces) {
    const int of_force = force->promises().reach;
    if (of_force == ForcePromises::everywhere) return {};
    reach = std::max(reach, of_force);
    sees_centroids = sees_centroids || force->promises().sees_centroids;
  }
  NeededRows needed = find_needed_rows(fibers, reach, owners);
  if (sees_centroids) needed.sections = count_sections(fibers, owners);
  return needed;
}

RankParts share_nodes(const std::vector<Fiber>& fibers, const int n_ranks) {
  double total = 0.0, before = 0.0;
  for (const Fiber& fiber : fibers) total += count_springs(fiber.config) * fiber.config.sections;
  std::vector<std::size_t> count(static_cast<std::size_t>(n_ranks));
  std::size_t rank = 0;
  for (const Fiber& fiber : fibers) {
    const double springs = count_springs(fiber.config);
    for (int section = 0; section < fiber.config.sections; ++section, before += springs) {
      while (rank + 1 < count.size() && (before + 0.5 * springs) * n_ranks > total * static_cast<double>(rank + 1))
        ++rank;
      count[rank] += static_cast<std::size_t>(fiber.config.nodes_per_section);
    }
  }
  return RankParts::behind_each_other(std::move(count));
}

ForceShare::ForceShare(const SceneConfig& asked, const int n_ranks) {
  const SceneConfig scene = resolve_chains(asked);
  const std::vector<Fiber> fibers = make_fibers(scene.fibers);
  forces = make_forces(scene, fibers);
  flow = make_background_flow(scene.flows);
  nodes = share_nodes(fibers, n_ranks);
  sections = std::make_unique<Sections>(fibers);
  needed = find_needed_rows(fibers, forces, nodes);
}

void ForceShare::compute(Communicator& ranks, const RankParts& nodes, const ForceList& forces, const double time,
                         const ConstVectors& position, const ConstVectors& displacement, const Vectors& force) {
  compute_own(ranks, nodes, forces, time, {position, {}, displacement, {}}, force);
  ranks.begin_work(RankWork::forces);
  gather_rows_to_all(ranks, nodes, force);
  ranks.end_work();
}

void ForceShare::compute_own(Communicator& ranks, const RankParts& nodes, const ForceList& forces, const double time,
                             const SeenNodes& seen, const Vectors& force) {
  SKEIN_REQUIRE(force.extent(0) == nodes.total() && seen.position.extent(0) == nodes.total(),
                "positions, forces and the nodes of the scene differ in number");
  const auto rank = static_cast<std::size_t>(ranks.rank());
  const int first = static_cast<int>(nodes.first[rank]), n = static_cast<int>(nodes.count[rank]);
  ranks.begin_work(RankWork::forces);
  Kokkos::deep_copy(ExecSpace(), rows_of(force, nodes.first[rank], nodes.count[rank]), 0.0);
  for (const auto& part : forces)
    if (seen.displacement.is_allocated())
      part->add_force_changes_on(first, n, time, seen, force);
    else
      part->add_forces_on(first, n, time, seen, force);
  ranks.end_work();
}

SharedForces::SharedForces(TeamLink& link, std::set<int>& numbers, const SceneConfig& scene,
                           const std::vector<Fiber>& fibers, const ForceList& forces)
    : link_(link),
      numbers_(numbers),
      nodes_(share_nodes(fibers, link.ranks.size())),
      needed_(find_needed_rows(fibers, forces, nodes_)) {
  for (const auto& force : forces) known_.push_back(force.get());
  while (!numbers_.insert(order_.scene).second) ++order_.scene;
  order_.kind = SumOrder::Kind::know_scene;
  std::string text = write_readable_scene(scene);
  order_.n_bytes = text.size();
  link_.send(order_);
  link_.ranks.broadcast(text.data(), text.size());
}

SharedForces::~SharedForces() { numbers_.erase(order_.scene); }

bool SharedForces::know(const ForceList& forces) const {
  const auto is_same = [](const auto& there, const Force* known) { return there.get() == known; };
  return std::equal(forces.begin(), forces.end(), known_.begin(), known_.end(), is_same);
}

bool SharedForces::compute(const ForceList& forces, const double time, const ConstVectors& position,
                           const ConstVectors& displacement, const Vectors& force) {
  link_.held = {};
  link_.forget_positions();
  if (!know(forces)) return false;
  order_.kind = displacement.is_allocated() ? SumOrder::Kind::compute_force_changes : SumOrder::Kind::compute_forces;
  order_.time = time;
  order_.n_sources = position.extent_int(0);
  link_.send(order_);
  send_vectors(link_.ranks, position);
  if (displacement.is_allocated()) send_vectors(link_.ranks, displacement);
  ForceShare::compute(link_.ranks, nodes_, forces, time, position, displacement, force);
  link_.held = {position.data(), force.data(), position.extent_int(0)};
  return true;
}

}  // namespace skein
