#include "kernels/stokeslet_images.hpp"

#include <skein/core/error.hpp>

#include "kernels/stokeslet_exchange.hpp"
#include "kernels/tournament.hpp"

#include <algorithm>
#include <cstddef>

namespace skein {
namespace {

constexpr int nodes_per_image_tile = 96;  // aimed at; of few nodes, so that threads find tiles
constexpr int max_image_tiles = 64;       // many nodes make so many larger ones

void cut_classes(const std::vector<OrbitClass>& classes, ImageMatches& plan) {
  for (const OrbitClass& run : classes) plan.n_orbits += run.count;
  const int aim = math::larger(nodes_per_image_tile, math::ceil_div(plan.n_orbits, max_image_tiles));
  for (int c = 0; c < plan.n_classes; ++c) {
    const OrbitClass& run = classes[static_cast<std::size_t>(c)];
    const int n_tiles = math::ceil_div(run.count, aim);
    const int size = math::ceil_div(run.count, n_tiles * tile_step) * tile_step;
    for (int i = 0; i < run.count; i += size)
      plan.tiles.push_back({{run.first + i, math::smaller(size, run.count - i)}, c});
  }
}

template <class Real>
void add_images(const HostSpace& space, const ImageMatches& plan, const HostSources& nodes,
                const VectorView<HostSpace>& velocity) {
  const int n_tiles = static_cast<int>(plan.tiles.size()), n_copies = nodes.position.extent_int(0) / plan.n_orbits;
  play_in_order("skein::add_image_stokeslet_velocity", space, n_copies * n_tiles, plan.matches,
                [&](const Match& match) {
                  HostSources weighted = nodes;
                  weighted.scale *= plan.weight_of(match);
                  const IndexRange one = plan.run_of(match.one), other = plan.run_of(match.other);
                  if (match.other % n_tiles == match.one)
                    add_within<Real>(weighted, one, other, velocity);
                  else
                    add_between<Real>(weighted, one, other, velocity);
                });
}

}  // namespace

IndexRange ImageMatches::run_of(const int tile) const {
  const int n_tiles = static_cast<int>(tiles.size());
  const IndexRange orbits = tiles[static_cast<std::size_t>(tile % n_tiles)].orbits;
  return {tile / n_tiles * n_orbits + orbits.first, orbits.count};
}

double ImageMatches::weight_of(const Match& match) const {
  const auto class_of = [&](const int tile) {
    return tiles[static_cast<std::size_t>(tile) % tiles.size()].orbit_class;
  };
  return weight[static_cast<std::size_t>(class_of(match.one) * n_classes + class_of(match.other))];
}

// The images of one pair of tiles are dealt to both in turn, so that two threads find work in them.
ImageMatches make_image_matches(const std::vector<SignMatrix>& group, const std::vector<OrbitClass>& classes) {
  ImageMatches plan;
  plan.n_classes = static_cast<int>(classes.size());
  cut_classes(classes, plan);
  std::vector<std::vector<int>> distinct;  // elements of the group by their numbers, for each pair of classes
  for (const OrbitClass& a : classes)
    for (const OrbitClass& b : classes) {
      const std::vector<SignMatrix> images = list_distinct_images(group, a, b);
      std::vector<int>& numbers = distinct.emplace_back();
      for (std::size_t e = 0; e < group.size(); ++e)
        if (std::find(images.begin(), images.end(), group[e]) != images.end()) numbers.push_back(static_cast<int>(e));
      plan.weight.push_back(static_cast<double>(group.size()) / static_cast<double>(images.size()));
    }
  const int n_tiles = static_cast<int>(plan.tiles.size());
  const auto images_between = [&](const int one, const int other) -> const std::vector<int>& {
    const auto class_of = [&](const int tile) { return plan.tiles[static_cast<std::size_t>(tile)].orbit_class; };
    return distinct[static_cast<std::size_t>(class_of(one) * plan.n_classes + class_of(other))];
  };
  for (int tile = 0; tile < n_tiles; ++tile)
    for (const int element : images_between(tile, tile)) plan.matches.push_back({tile, element * n_tiles + tile});
  for (const auto& [one, other] : list_tournament(n_tiles)) {
    bool is_swapped = false;
    for (const int element : images_between(one, other)) {
      const int first = is_swapped ? other : one, image = is_swapped ? one : other;
      plan.matches.push_back({first, element * n_tiles + image});
      is_swapped = !is_swapped;
    }
  }
  count_turns(static_cast<int>(group.size()) * n_tiles, plan.matches);
  return plan;
}

void add_image_stokeslet_velocity(const HostSpace& space, const ImageMatches& matches,
                                  const ConstVectorView<HostSpace>& position, const ConstVectorView<HostSpace>& force,
                                  const ConstScalarView<HostSpace>& blob, const VectorView<HostSpace>& velocity,
                                  const double viscosity, const Precision precision) {
  SKEIN_REQUIRE(position.extent(0) == force.extent(0) && position.extent(0) == blob.extent(0) &&
                    position.extent(0) == velocity.extent(0),
                "positions, forces, blobs and velocities differ in number");
  if (position.extent(0) == 0) return;
  const HostSources nodes{position, force, blob, regularized_stokeslet::scale(viscosity)};
  with_precision(precision, [&](auto number) { add_images<decltype(number)>(space, matches, nodes, velocity); });
}

}  // namespace skein
