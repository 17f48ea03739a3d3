#include "fmm/fmm_translations.hpp"

#include "fmm/host_scratch.hpp"
#include "fmm/pair_batch.hpp"
#include "fmm/source_potentials.hpp"

#include <algorithm>
#include <string>

namespace skein {
namespace {

using Tasks = Kokkos::RangePolicy<HostSpace, Kokkos::Schedule<Kokkos::Dynamic>>;

template <class Real>
const OperatorSet<Real>& operators_of(const std::vector<const OperatorSet<Real>*>& levels, const int level) {
  return *levels[static_cast<std::size_t>(level)];
}

/// Sources of leaves to their coefficients (P2M); zero for other boxes.
template <class Real, class Field>
void run_p2m(const HostOctree& tree, const SortedNodes& nodes, const Field& field,
             const std::vector<const OperatorSet<Real>*>& levels, const Coefficients<Real>& coefficients,
             const IndexRange boxes) {
  for (int b = boxes.first; b < boxes.first + boxes.count; ++b) {
    const Box& box = tree.box(b);
    Real* const own = coefficients.source.data() + static_cast<std::ptrdiff_t>(b) * coefficients.box_size;
    std::fill(own, own + coefficients.box_size, Real(0));
    if (!box.is_leaf() || box.sources.count == 0) continue;
    const auto& operators = operators_of(levels, box.level);
    const int n_values = Field::n_planes * operators.n_padded;
    const HostScratch<Real> potential(n_values);
    std::fill(potential.get(), potential.get() + n_values, Real(0));
    const double half_width = tree.half_width(box.level);
    add_run_potentials(nodes, box.sources, tree.cube.center(box), half_width, field.at(half_width), operators,
                       outer_surface, potential.get());
    operators.to_source.apply(potential.get(), operators.to_source.n_columns, Field::n_columns, own,
                              coefficients.stride);
  }
}

/// The branches of a tree: everything below (and with) one box of a level that has a few for every thread. A branch's
/// boxes of each level stand together, and branches do not meet, so that one parallel loop over branches does all their
/// levels; the few boxes above are left to one thread. Which level it is changes no result.
struct Branches {
  explicit Branches(const HostOctree& tree) : level(first_far_level) {
    const int wanted = 8 * HostSpace().concurrency();
    for (int l = first_far_level; l < tree.n_levels() && tree.level(level).count < wanted; ++l)
      if (tree.level(l).count > tree.level(level).count) level = l;
    roots = tree.level(level);
  }
  /// The boxes of a branch, level by level.
  static std::vector<IndexRange> boxes_of(const HostOctree& tree, const int root) {
    std::vector<IndexRange> runs = {{root, 1}};
    while (true) {
      IndexRange below;
      for (int b = runs.back().first; b < runs.back().first + runs.back().count; ++b) {
        const Box& box = tree.box(b);
        if (box.is_leaf()) continue;
        if (below.count == 0) below.first = box.first_child;
        below.count += box.n_children;
      }
      if (below.count == 0) return runs;
      runs.push_back(below);
    }
  }

  int level;
  IndexRange roots;
};

/// Children to parents of one level (M2M).
template <class Real, class Field>
void run_m2m(const HostOctree& tree, const std::vector<const OperatorSet<Real>*>& levels,
             const Coefficients<Real>& coefficients, const int level, const IndexRange parents) {
  if (level + 1 >= tree.n_levels()) return;
  const auto& own = operators_of(levels, level);
  const auto& below = operators_of(levels, level + 1);
  PairBatch<Real, Field> batch(below.rank_padded, own.rank_padded);
  for (int p = parents.first; p < parents.first + parents.count; ++p) {
    const Box& parent = tree.box(p);
    for (int i = 0; i < parent.n_children; ++i) {
      const int child = parent.first_child + i;
      const Box& box = tree.box(child);
      if (box.sources.count == 0) continue;
      // In the parent's units the child's centre is half a unit off along each axis, and psi half as large.
      Real shift[3];
      for (int c = 0; c < 3; ++c) shift[c] = Real(0.5) * Real(child_side(box.octant, c));
      const int reflected = 7 & ~box.octant;
      batch.add(coefficients.source.data() + static_cast<std::ptrdiff_t>(child) * coefficients.box_size,
                coefficients.stride, below.rank_padded, &below.sign(0, reflected), Real(0.5), shift,
                coefficients.source.data() + static_cast<std::ptrdiff_t>(p) * coefficients.box_size,
                &own.sign(0, reflected));
      if (batch.is_full()) batch.apply(own.to_parent, coefficients.stride);
    }
  }
  batch.apply(own.to_parent, coefficients.stride);
}

/// P2M and M2M of all boxes.
template <class Real, class Field>
void compute_source_coefficients(const HostOctree& tree, const SortedNodes& nodes, const Field& field,
                                 const std::vector<const OperatorSet<Real>*>& levels,
                                 const Coefficients<Real>& coefficients) {
  const Branches branches(tree);
  Kokkos::parallel_for("skein::compute_source_coefficients", Tasks(HostSpace(), 0, branches.roots.count),
                       [&](const int k) {
                         const std::vector<IndexRange> runs = Branches::boxes_of(tree, branches.roots.first + k);
                         for (int depth = static_cast<int>(runs.size()) - 1; depth >= 0; --depth) {
                           const IndexRange boxes = runs[static_cast<std::size_t>(depth)];
                           run_p2m<Real, Field>(tree, nodes, field, levels, coefficients, boxes);
                           run_m2m<Real, Field>(tree, levels, coefficients, branches.level + depth, boxes);
                         }
                       });
  for (int level = branches.level - 1; level >= first_far_level; --level) {
    run_p2m<Real, Field>(tree, nodes, field, levels, coefficients, tree.level(level));
    run_m2m<Real, Field>(tree, levels, coefficients, level, tree.level(level));
  }
}

/// Boxes whose V lists make one task: of one level. @param boxes_of_level  that are to be in a task
std::vector<IndexRange> make_transfer_tasks(const HostOctree& tree, const std::vector<IndexRange>& boxes_of_level) {
  constexpr int min_pairs = 48, max_boxes = 64;
  const auto& first_pair = tree.v_list.first;
  std::vector<IndexRange> tasks;
  for (int level = first_far_level; level < tree.n_levels(); ++level) {
    const IndexRange boxes = boxes_of_level[static_cast<std::size_t>(level)];
    IndexRange task{boxes.first, 0};
    int n_pairs = 0;
    const int enough = math::larger(min_pairs, (first_pair(boxes.first + boxes.count) - first_pair(boxes.first)) / 16);
    for (int b = boxes.first; b < boxes.first + boxes.count; ++b) {
      ++task.count;
      n_pairs += first_pair(b + 1) - first_pair(b);
      if (n_pairs >= enough || task.count == max_boxes) {
        tasks.push_back(task);
        task = {b + 1, 0};
        n_pairs = 0;
      }
    }
    if (task.count > 0) tasks.push_back(task);
  }
  return tasks;
}

/// Across the V lists (M2L) and from the sources of X lists (P2L); overwrites the coefficients for targets.
template <class Real, class Field>
void run_m2l_and_p2l(const HostOctree& tree, const SortedNodes& nodes, const Field& field,
                     const std::vector<const OperatorSet<Real>*>& levels, const Coefficients<Real>& coefficients,
                     const std::vector<IndexRange>& boxes_of_level) {
  const std::vector<IndexRange> tasks = make_transfer_tasks(tree, boxes_of_level);
  const auto across = [&](const int t) {
    const IndexRange boxes = tasks[static_cast<std::size_t>(t)];
    const int level = tree.box(boxes.first).level;
    const auto& operators = operators_of(levels, level);
    Real* const all = coefficients.target.data();
    const std::ptrdiff_t size = coefficients.box_size;
    std::fill(all + boxes.first * size, all + (boxes.first + boxes.count) * size, Real(0));

    // Pairs in the order of their transfer vectors, and of the lists among equals.
    const FarPair* const pairs = tree.v_list.of(boxes.first).data();
    const int n_pairs = tree.v_list.first(boxes.first + boxes.count) - tree.v_list.first(boxes.first);
    int place[n_transfers + 1] = {};
    for (int k = 0; k < n_pairs; ++k) ++place[transfer_index(pairs[k].transfer) + 1];
    for (int index = 0; index < n_transfers; ++index) place[index + 1] += place[index];
    const HostScratch<int> order(math::larger(1, n_pairs));
    int next[n_transfers];
    std::copy(place, place + n_transfers, next);
    for (int k = 0; k < n_pairs; ++k) order.get()[next[transfer_index(pairs[k].transfer)]++] = k;

    PairBatch<Real, Field> batch(operators.rank_padded, operators.rank_padded);
    for (int index = 0; index < n_transfers; ++index) {
      for (int k = place[index]; k < place[index + 1]; ++k) {
        const FarPair& pair = pairs[order.get()[k]];
        const int reflected = reflected_axes(pair.transfer);
        const Real shift[3] = {Real(2 * pair.transfer[0]), Real(2 * pair.transfer[1]), Real(2 * pair.transfer[2])};
        batch.add(coefficients.source.data() + pair.source * size, coefficients.stride, operators.rank_padded,
                  &operators.sign(0, reflected), Real(1), shift, all + pair.target * size,
                  &operators.sign(0, reflected));
        if (batch.is_full()) batch.apply(operators.transfer[index], coefficients.stride);
      }
      batch.apply(operators.transfer[index], coefficients.stride);
    }

    for (int b = boxes.first; b < boxes.first + boxes.count; ++b) {
      if (tree.x_list.of(b).empty()) continue;
      const double half_width = tree.half_width(level);
      const int n_values = Field::n_planes * operators.n_padded;
      const HostScratch<Real> potential(n_values), sum(static_cast<int>(size));
      std::fill(potential.get(), potential.get() + n_values, Real(0));
      for (const int a : tree.x_list.of(b))
        add_run_potentials(nodes, tree.box(a).sources, tree.cube.center(tree.box(b)), half_width, field.at(half_width),
                           operators, inner_surface, potential.get());
      operators.to_target.apply(potential.get(), operators.to_target.n_columns, Field::n_columns, sum.get(),
                                coefficients.stride);
      scatter<Field>(sum.get(), coefficients.stride, operators.rank_padded, &operators.sign(0, 0), all + b * size,
                     coefficients.stride);
    }
  };
  Kokkos::parallel_for("skein::run_m2l_and_p2l", Tasks(HostSpace(), 0, static_cast<int>(tasks.size())), across);
}

/// Parents to children of one level (L2L).
template <class Real, class Field>
void run_l2l(const HostOctree& tree, const std::vector<const OperatorSet<Real>*>& levels,
             const Coefficients<Real>& coefficients, const int level, const IndexRange boxes) {
  const auto& own = operators_of(levels, level);
  const auto& above = operators_of(levels, level - 1);
  PairBatch<Real, Field> batch(above.rank_padded, own.rank_padded);
  for (int b = boxes.first; b < boxes.first + boxes.count; ++b) {
    const Box& box = tree.box(b);
    if (box.targets.count == 0) continue;
    Real shift[3];
    for (int c = 0; c < 3; ++c) shift[c] = Real(-child_side(box.octant, c));
    const int reflected = 7 & ~box.octant;
    batch.add(coefficients.target.data() + static_cast<std::ptrdiff_t>(box.parent) * coefficients.box_size,
              coefficients.stride, above.rank_padded, &above.sign(0, reflected), Real(2), shift,
              coefficients.target.data() + static_cast<std::ptrdiff_t>(b) * coefficients.box_size,
              &own.sign(0, reflected));
    if (batch.is_full()) batch.apply(above.to_child, coefficients.stride);
  }
  batch.apply(above.to_child, coefficients.stride);
}

template <class Real, class Field>
void run_l2l_of_all_levels(const HostOctree& tree, const std::vector<const OperatorSet<Real>*>& levels,
                           const Coefficients<Real>& coefficients) {
  const Branches branches(tree);
  for (int level = first_far_level + 1; level <= branches.level; ++level)
    run_l2l<Real, Field>(tree, levels, coefficients, level, tree.level(level));
  Kokkos::parallel_for("skein::run_l2l", Tasks(HostSpace(), 0, branches.roots.count), [&](const int k) {
    const std::vector<IndexRange> runs = Branches::boxes_of(tree, branches.roots.first + k);
    for (int depth = 1; depth < static_cast<int>(runs.size()); ++depth)
      run_l2l<Real, Field>(tree, levels, coefficients, branches.level + depth, runs[static_cast<std::size_t>(depth)]);
  });
}

/// A parallel loop over some boxes, a few of them at once.
template <class Use>
void for_chunks(const std::string& label, const IndexRange boxes, const Use& use) {
  constexpr int most = 64;
  const int wanted = math::ceil_div(boxes.count, 8 * HostSpace().concurrency());
  const int size = math::larger(1, math::smaller(most, wanted)), n_chunks = math::ceil_div(boxes.count, size);
  Kokkos::parallel_for(label, Tasks(HostSpace(), 0, n_chunks), [&](const int chunk) {
    const int first = chunk * size;
    use(IndexRange{boxes.first + first, math::smaller(size, boxes.count - first)});
  });
}

}  // namespace

template <class Real, class Field>
void compute_coefficients(const HostOctree& tree, const SortedNodes& nodes, const Field& field,
                          const std::vector<const OperatorSet<Real>*>& levels, const Coefficients<Real>& coefficients) {
  if (tree.n_levels() <= first_far_level) return;
  compute_source_coefficients<Real, Field>(tree, nodes, field, levels, coefficients);
  std::vector<IndexRange> all;
  for (int level = 0; level < tree.n_levels(); ++level) all.push_back(tree.level(level));
  run_m2l_and_p2l<Real, Field>(tree, nodes, field, levels, coefficients, all);
  run_l2l_of_all_levels<Real, Field>(tree, levels, coefficients);
}

// Level by level: branches end somewhere between ranks.
template <class Real, class Field>
void compute_shared_coefficients(const HostOctree& tree, const SortedNodes& nodes, const Field& field,
                                 const std::vector<const OperatorSet<Real>*>& levels,
                                 const Coefficients<Real>& coefficients, const RankShares& shares,
                                 const std::function<void()>& exchange) {
  if (tree.n_levels() <= first_far_level) return;
  for (int level = tree.n_levels() - 1; level >= first_far_level; --level)
    for_chunks("skein::compute_shared_coefficients", shares.source_boxes[static_cast<std::size_t>(level)],
               [&](const IndexRange boxes) {
                 run_p2m<Real, Field>(tree, nodes, field, levels, coefficients, boxes);
                 run_m2m<Real, Field>(tree, levels, coefficients, level, boxes);
               });
  exchange();
  for (const int b : shares.boxes_of_all) {
    run_p2m<Real, Field>(tree, nodes, field, levels, coefficients, {b, 1});
    run_m2m<Real, Field>(tree, levels, coefficients, tree.box(b).level, {b, 1});
  }
  run_m2l_and_p2l<Real, Field>(tree, nodes, field, levels, coefficients, shares.target_boxes);
  for (int level = first_far_level + 1; level < tree.n_levels(); ++level)
    for_chunks("skein::run_l2l", shares.target_boxes[static_cast<std::size_t>(level)],
               [&](const IndexRange boxes) { run_l2l<Real, Field>(tree, levels, coefficients, level, boxes); });
}

#define SKEIN_INSTANTIATE(Real, Field)                                                                   \
  template void compute_coefficients<Real, Field>(const HostOctree&, const SortedNodes&, const Field&,   \
                                                  const std::vector<const OperatorSet<Real>*>&,          \
                                                  const Coefficients<Real>&);                            \
  template void compute_shared_coefficients<Real, Field>(                                                \
      const HostOctree&, const SortedNodes&, const Field&, const std::vector<const OperatorSet<Real>*>&, \
      const Coefficients<Real>&, const RankShares&, const std::function<void()>&);
SKEIN_INSTANTIATE(double, HarmonicField)
SKEIN_INSTANTIATE(float, HarmonicField)
SKEIN_INSTANTIATE(double, StokesletField)
SKEIN_INSTANTIATE(float, StokesletField)
SKEIN_INSTANTIATE(double, RegularizedField)
SKEIN_INSTANTIATE(float, RegularizedField)

}  // namespace skein
