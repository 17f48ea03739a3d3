#include "kernels/penetration.hpp"

#include <skein/arrays/launch.hpp>
#include <skein/core/error.hpp>

#include "kernels/tube_prism.hpp"

#include <limits>
#include <numbers>

namespace skein {
namespace {

constexpr double half_turn_of_space = 2.0 * std::numbers::pi;  ///< solid angle halfway between inside and outside

/// Looks for the nodes of one block of sections inside of surfaces; on devices for some nodes of one section.
template <class Space>
struct PenetrationSearch {
  static constexpr double margin = 1e-9;                   ///< in radii, for rounding
  static constexpr int n_shares = on_host<Space> ? 1 : 8;  ///< of a section's nodes
  static constexpr int items_per_block = on_host<Space> ? 1 : sections_per_block * n_shares;
  TubeSurfaces<Space> surfaces;
  ScalarView<Space> depth;

  KOKKOS_INLINE_FUNCTION void operator()(const int item, int& count) const {
    const int block = item / items_per_block;
    const int f = surfaces.sections.fiber_of_block(block);
    const FiberSections& fiber = surfaces.sections.fiber(f);
    int section = fiber.first_section_of(block), end = fiber.end_section_of(block), share = 0;
    if constexpr (items_per_block > 1) {
      section += item % items_per_block / n_shares;
      share = item % n_shares;
      if (section >= end) return;
      end = section + 1;
    }
    const int first_node = fiber.first_node_of(section) + share, end_node = fiber.first_node_of(end);
    for (int node = first_node; node < end_node; node += n_shares) depth(node) = 0.0;
    search(f, section, end, share);
    for (int node = first_node; node < end_node; node += n_shares) count += depth(node) > 0.0;
  }

  /// What sections [first, end) of a fiber do not see of their own.
  KOKKOS_INLINE_FUNCTION HiddenPrisms hidden_from(const FiberSections& fiber, const int first, const int end) const {
    return {end - 1 - fiber.distant_sections, first + fiber.distant_sections};
  }

  /// @param share  of the nodes of each section: every n_shares-th from this one on
  KOKKOS_INLINE_FUNCTION void search(const int f, const int first, const int end, const int share) const {
    const FiberSections& fiber = surfaces.sections.fiber(f);
    Vec3 low, high;
    enclose<Space>(surfaces.ring_low, surfaces.ring_high, first, end, low, high);
    const int n_fibers = surfaces.sections.fiber.extent_int(0);
    for (int tube = 0; tube < n_fibers; ++tube) {
      if (surfaces.sections.fiber(tube).nodes_per_section < 3) continue;  // chains have no surface to be inside of
      if (!touch(low, high, surfaces.fiber_low, surfaces.fiber_high, tube)) continue;
      const HiddenPrisms hidden = tube == f ? hidden_from(fiber, first, end) : HiddenPrisms{};
      if (!is_near_some_block(low, high, tube, hidden, [](int, int) { return true; })) continue;
      for (int section = first; section < end; ++section) search_section(f, section, share, tube);
    }
  }

  KOKKOS_INLINE_FUNCTION void search_section(const int f, const int section, const int share, const int tube) const {
    const FiberSections& fiber = surfaces.sections.fiber(f);
    const HiddenPrisms hidden = tube == f ? hidden_from(fiber, section, section + 1) : HiddenPrisms{};
    const Vec3 low = load(surfaces.ring_low, section), high = load(surfaces.ring_high, section);
    if (!is_near_some_block(low, high, tube, hidden, [&](const int first, const int end) {
          for (int prism = first; prism < end; ++prism)
            if (!hidden.hides(prism) && squared_distance_to_prism(surfaces, prism, low, high) == 0.0) return true;
          return false;
        }))
      return;
    const int end_node = fiber.first_node_of(section + 1);
    for (int node = fiber.first_node_of(section) + share; node < end_node; node += n_shares) {
      const double found = depth_in(tube, hidden, load(surfaces.position, node));
      if (found > depth(node)) depth(node) = found;
    }
  }

  KOKKOS_INLINE_FUNCTION bool touch(const Vec3 low, const Vec3 high, const VectorView<Space>& lows,
                                    const VectorView<Space>& highs, const int box) const {
    return squared_distance(low, high, load(lows, box), load(highs, box)) == 0.0;
  }

  /// True where a box touches that of a block whose prisms [first, end) are seen and judge(first, end) says yes.
  template <class Judge>
  KOKKOS_INLINE_FUNCTION bool is_near_some_block(const Vec3 low, const Vec3 high, const int tube,
                                                 const HiddenPrisms& hidden, const Judge& judge) const {
    const FiberSections& fiber = surfaces.sections.fiber(tube);
    for (int block = fiber.first_block; block < fiber.end_block(); ++block) {
      const int first = fiber.first_section_of(block), end = end_prism_of(fiber, block);
      if (!hidden.hides_all(first, end) && touch(low, high, surfaces.block_low, surfaces.block_high, block) &&
          judge(first, end))
        return true;
    }
    return false;
  }

  /// 0 outside of the tube.
  KOKKOS_INLINE_FUNCTION double depth_in(const int tube, const HiddenPrisms& hidden, const Vec3 point) const {
    double angle = 0.0, least = std::numeric_limits<double>::max();
    for_each_prism_within(0.0, tube, hidden, point, [&](const PrismView<Space>& prism) {
      const double part = prism.compute_solid_angle();
      angle += part;
      // The nearest surface is rarely another prism's: the search below begins with a distance to beat.
      const double square = part > half_turn_of_space ? prism.squared_distance() : least;
      if (square < least) least = square;
    });
    if (!(angle > half_turn_of_space)) return 0.0;
    for_each_prism_within(least, tube, hidden, point, [&](const PrismView<Space>& prism) {
      const double square = prism.squared_distance();
      if (square < least) least = square;
    });
    // Nodes of planar fibers lie on each other's surfaces: rounding does not decide.
    const double nearest = math::sqrt(least);
    return nearest > margin * surfaces.sections.fiber(tube).radius ? nearest : 0.0;
  }

  /// Calls body(prism) for those of a tube's prisms that may be within a distance of a point.
  /// @param square  of the distance; a body may make it smaller
  template <class Body>
  KOKKOS_INLINE_FUNCTION void for_each_prism_within(const double& square, const int tube, const HiddenPrisms& hidden,
                                                    const Vec3 point, const Body& body) const {
    // A point on the face that two prisms share must see both.
    const FiberSections& fiber = surfaces.sections.fiber(tube);
    for (int block = fiber.first_block; block < fiber.end_block(); ++block) {
      double distance = math::sqrt(square) + margin * fiber.radius;
      if (squared_distance(point, point, load(surfaces.block_low, block), load(surfaces.block_high, block)) >
          distance * distance)
        continue;
      const int end = end_prism_of(fiber, block);
      for (int prism = fiber.first_section_of(block); prism < end; ++prism) {
        if (hidden.hides(prism)) continue;
        const PrismView<Space> view(surfaces, fiber, prism, point);
        if (!view.may_be_within(distance)) continue;
        body(view);
        distance = math::sqrt(square) + margin * fiber.radius;
      }
    }
  }
};

}  // namespace

template <class Space>
void seek_nodes_inside(const Space& space, const TubeSurfaces<Space>& surfaces, const ScalarView<Space>& depth,
                       const FoundNumber& n_inside) {
  SKEIN_REQUIRE(depth.extent(0) == surfaces.position.extent(0), "one depth for each node is needed");
  using Search = PenetrationSearch<Space>;
  launch_reduction<Space>("skein::seek_nodes_inside", space,
                          Calls{surfaces.sections.fiber_of_block.extent_int(0) * Search::items_per_block, 2.5e3},
                          Search{surfaces, depth}, Kokkos::Sum<int, SharedHostMemory>(n_inside));
}

template <class Space>
double find_largest_depth(const Space& space, const ScalarView<Space>& depth) {
  double largest = 0.0;
  launch_reduction<Space>(
      "skein::find_largest_depth", space, Calls{depth.extent_int(0), 1.0},
      KOKKOS_LAMBDA(const int node, double& most) {
        if (depth(node) > most) most = depth(node);
      },
      Kokkos::Max<double>(largest));
  return largest;
}

#define SKEIN_INSTANTIATE(S)                                                                                      \
  template void seek_nodes_inside<S>(const S&, const TubeSurfaces<S>&, const ScalarView<S>&, const FoundNumber&); \
  template double find_largest_depth<S>(const S&, const ScalarView<S>&);
SKEIN_FOR_EACH_EXEC_SPACE(SKEIN_INSTANTIATE)

}  // namespace skein
