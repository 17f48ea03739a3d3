#include "kernels/section_repulsion.hpp"

#include <skein/core/error.hpp>

namespace skein {
namespace {

/// Two sections within the range, seen from the first.
struct SectionPair {
  int section, other;
  Vec3 d;            ///< section - other, length
  double distance;   ///< length
  double closeness;  ///< 1 - gap / range, above 0
  double scale;      ///< strength h h', force * length
  double range;      ///< length
};

/// Force over distance on the first section, 0 at coincidence.
KOKKOS_INLINE_FUNCTION double push_of(const SectionPair& pair) {
  const double moment = pair.range * pair.distance;
  return moment > 0.0 ? pair.scale * pair.closeness * pair.closeness / moment : 0.0;
}

template <class Space>
KOKKOS_INLINE_FUNCTION void add_to_nodes(const VectorView<Space>& vector, const FiberSections& fiber, const int section,
                                         const Vec3 sum) {
  const int n = fiber.nodes_per_section;
  const int first = fiber.first_node_of(section);
  const Vec3 part = sum / static_cast<double>(n);
  for (int node = first; node < first + n; ++node) store(vector, node, load(vector, node) + part);
}

// What is summed over pairs, and what is done with a section's sum.

template <class Space>
struct ForceTerm {
  using Value = Vec3;
  VectorView<Space> force;
  KOKKOS_INLINE_FUNCTION Vec3 value(const SectionPair& pair) const { return push_of(pair) * pair.d; }
  KOKKOS_INLINE_FUNCTION void finish(const FiberSections& fiber, const int section, const Vec3 sum) const {
    add_to_nodes<Space>(force, fiber, section, sum);
  }
};

template <class Space>
struct ChangeTerm {
  using Value = Vec3;
  ConstVectorView<Space> displacement;
  VectorView<Space> change;
  KOKKOS_INLINE_FUNCTION Vec3 value(const SectionPair& pair) const {
    const double push = push_of(pair);
    if (push == 0.0) return {};
    const Vec3 v = load(displacement, pair.section) - load(displacement, pair.other);
    const Vec3 along = dot(pair.d, v) / (pair.distance * pair.distance) * pair.d;
    const double slope = 2.0 * pair.scale * pair.closeness / (pair.range * pair.range);
    return push * (v - along) - slope * along;
  }
  KOKKOS_INLINE_FUNCTION void finish(const FiberSections& fiber, const int section, const Vec3 sum) const {
    add_to_nodes<Space>(change, fiber, section, sum);
  }
};

struct EnergyTerm {
  using Value = double;
  FoundReals energy;
  KOKKOS_INLINE_FUNCTION double value(const SectionPair& pair) const {
    return pair.scale * pair.closeness * pair.closeness * pair.closeness / 6.0;
  }
  KOKKOS_INLINE_FUNCTION void finish(const FiberSections&, const int section, const double sum) const {
    energy(section) = sum;
  }
};

struct SymmetricMatrix {
  Vec3 diagonal, mixed;
  KOKKOS_INLINE_FUNCTION friend SymmetricMatrix operator+(const SymmetricMatrix& a, const SymmetricMatrix& b) {
    return {a.diagonal + b.diagonal, a.mixed + b.mixed};
  }
};

template <class Space>
struct MomentTerm {
  using Value = SymmetricMatrix;
  VectorView<Space> diagonal, mixed;
  KOKKOS_INLINE_FUNCTION SymmetricMatrix value(const SectionPair& pair) const {
    const Vec3 d = pair.d, half = 0.5 * push_of(pair) * d;
    return {{half.x * d.x, half.y * d.y, half.z * d.z}, {half.y * d.z, half.x * d.z, half.x * d.y}};
  }
  KOKKOS_INLINE_FUNCTION void finish(const FiberSections&, const int section, const SymmetricMatrix& sum) const {
    store(diagonal, section, sum.diagonal);
    store(mixed, section, sum.mixed);
  }
};

constexpr int blocks_at_once = 8;  // of a host's thread: 128 sums lie on its stack

/// Sums over near sections: on hosts for several blocks of a fiber at once, which share the search, on devices for one
/// section. Either way in the order of the sections.
template <class Space, class Term>
struct Gathering {
  static constexpr int items_per_block = on_host<Space> ? 1 : sections_per_block;
  SectionBoxes<Space> boxes;
  RepulsionLaw law;
  Term term;
  int first_block;

  KOKKOS_INLINE_FUNCTION void operator()(const int item) const {
    const int block = item / items_per_block;
    const int f = boxes.fiber_of_block(block);
    if constexpr (items_per_block == 1)
      gather_blocks(f, block);
    else
      gather_section(f, block, item % items_per_block);
  }

  /// Of the block and those that follow it on its fiber.
  KOKKOS_INLINE_FUNCTION void gather_blocks(const int f, const int block) const {
    const FiberSections& fiber = boxes.fiber(f);
    const int behind = (block - fiber.first_block) % blocks_at_once;
    if (behind != 0 && block != first_block) return;
    const int end_block = math::smaller(block + blocks_at_once - behind, fiber.end_block());
    const int first = fiber.first_section_of(block);
    const double margin = law.range + fiber.radius;
    Vec3 low, high;
    enclose<Space>(boxes.block_low, boxes.block_high, block, end_block, low, high);

    typename Term::Value sum[blocks_at_once * sections_per_block] = {};
    for_each_near_block<Space>(boxes, low, high, margin, [&](const int other_f, const int other_block) {
      const double reach = margin + boxes.fiber(other_f).radius;
      const Vec3 other_low = load(boxes.block_low, other_block), other_high = load(boxes.block_high, other_block);
      for (int own = block; own < end_block; ++own) {
        if (squared_distance(load(boxes.block_low, own), load(boxes.block_high, own), other_low, other_high) >
            reach * reach)
          continue;
        const int end = fiber.end_section_of(own);
        for (int section = fiber.first_section_of(own); section < end; ++section)
          sum[section - first] = add_block(f, section, other_f, other_block, sum[section - first]);
      }
    });
    const int end = fiber.end_section_of(end_block - 1);
    for (int section = first; section < end; ++section) term.finish(fiber, section, sum[section - first]);
  }

  KOKKOS_INLINE_FUNCTION void gather_section(const int f, const int block, const int place) const {
    const FiberSections& fiber = boxes.fiber(f);
    const int section = fiber.first_section_of(block) + place;
    if (section >= fiber.end_section_of(block)) return;
    const Vec3 x = load(boxes.centroid, section);
    typename Term::Value sum{};
    for_each_near_block<Space>(boxes, x, x, law.range + fiber.radius, [&](const int other_f, const int other_block) {
      sum = add_block(f, section, other_f, other_block, sum);
    });
    term.finish(fiber, section, sum);
  }

  /// The sum so far, with the pairs of a section with those of a block.
  KOKKOS_INLINE_FUNCTION typename Term::Value add_block(const int f, const int section, const int other_f,
                                                        const int block, typename Term::Value sum) const {
    const FiberSections &fiber = boxes.fiber(f), &other_fiber = boxes.fiber(other_f);
    const double radii = fiber.radius + other_fiber.radius;
    const double limit = (law.range + radii) * (law.range + radii);
    const double scale = law.strength * (fiber.spacing * other_fiber.spacing);
    const Vec3 x = load(boxes.centroid, section);
    const int end = other_fiber.end_section_of(block);
    for (int other = other_fiber.first_section_of(block); other < end; ++other) {
      const int apart = other > section ? other - section : section - other;
      if (f == other_f && apart < fiber.distant_sections) continue;
      const Vec3 d = x - load(boxes.centroid, other);
      const double d_squared = dot(d, d);
      if (!(d_squared < limit)) continue;
      const double distance = math::sqrt(d_squared);
      const double closeness = 1.0 - (distance - radii) / law.range;
      if (closeness > 0.0) sum = sum + term.value({section, other, d, distance, closeness, scale, law.range});
    }
    return sum;
  }
};

template <class Space, class Term>
void gather(const char* label, const Space& space, const SectionBoxes<Space>& boxes, const RepulsionLaw& law,
            const IndexRange blocks, const Term& term) {
  using Kernel = Gathering<Space, Term>;
  constexpr int n = Kernel::items_per_block;
  Kokkos::parallel_for(label, Kokkos::RangePolicy<Space>(space, blocks.first * n, (blocks.first + blocks.count) * n),
                       Kernel{boxes, law, term, blocks.first});
}

}  // namespace

template <class Space>
void add_section_repulsion(const Space& space, const SectionBoxes<Space>& boxes, const RepulsionLaw& law,
                           const IndexRange blocks, const VectorView<Space>& force) {
  gather("skein::add_section_repulsion", space, boxes, law, blocks, ForceTerm<Space>{force});
}

template <class Space>
void add_section_repulsion_change(const Space& space, const SectionBoxes<Space>& boxes, const RepulsionLaw& law,
                                  const IndexRange blocks, const ConstVectorView<Space>& displacement,
                                  const VectorView<Space>& change) {
  SKEIN_REQUIRE(displacement.extent(0) == boxes.centroid.extent(0), "one displacement for each section is needed");
  gather("skein::add_section_repulsion_change", space, boxes, law, blocks, ChangeTerm<Space>{displacement, change});
}

template <class Space>
void compute_repulsion_energy(const Space& space, const SectionBoxes<Space>& boxes, const RepulsionLaw& law,
                              const FoundReals& energy) {
  SKEIN_REQUIRE(energy.extent(0) == boxes.centroid.extent(0), "one energy for each section is needed");
  gather("skein::compute_repulsion_energy", space, boxes, law, all_blocks<Space>(boxes), EnergyTerm{energy});
}

template <class Space>
void compute_repulsion_moment(const Space& space, const SectionBoxes<Space>& boxes, const RepulsionLaw& law,
                              const VectorView<Space>& diagonal, const VectorView<Space>& mixed) {
  SKEIN_REQUIRE(diagonal.extent(0) == boxes.centroid.extent(0) && mixed.extent(0) == diagonal.extent(0),
                "one moment for each section is needed");
  gather("skein::compute_repulsion_moment", space, boxes, law, all_blocks<Space>(boxes),
         MomentTerm<Space>{diagonal, mixed});
}

#define SKEIN_INSTANTIATE(S)                                                                                           \
  template void add_section_repulsion<S>(const S&, const SectionBoxes<S>&, const RepulsionLaw&, IndexRange,            \
                                         const VectorView<S>&);                                                        \
  template void add_section_repulsion_change<S>(const S&, const SectionBoxes<S>&, const RepulsionLaw&, IndexRange,     \
                                                const ConstVectorView<S>&, const VectorView<S>&);                      \
  template void compute_repulsion_energy<S>(const S&, const SectionBoxes<S>&, const RepulsionLaw&, const FoundReals&); \
  template void compute_repulsion_moment<S>(const S&, const SectionBoxes<S>&, const RepulsionLaw&,                     \
                                            const VectorView<S>&, const VectorView<S>&);
SKEIN_FOR_EACH_EXEC_SPACE(SKEIN_INSTANTIATE)

}  // namespace skein
