#include "fmm/fmm_translations.hpp"

#include "fmm/host_scratch.hpp"

#include <algorithm>

namespace skein {
namespace {

using simd::Pack;
using Tasks = Kokkos::RangePolicy<HostSpace, Kokkos::Schedule<Kokkos::Dynamic>>;

constexpr int tile = 128;  // sources whose units are changed at once

template <class Real>
const OperatorSet<Real>& operators_of(const std::vector<const OperatorSet<Real>*>& levels, const int level) {
  return *levels[static_cast<std::size_t>(level)];
}

template <class Real>
void load_far_sources(const SortedNodes& nodes, const int first, const int count, const Vec3 center,
                      const double half_width, FarSource<Real>* sources) {
  const double to_units = 1.0 / half_width;
  for (int s = 0; s < count; ++s) {
    const int i = first + s;
    const Vec3 y = to_units * (load(nodes.position, i) - center);
    const double blob = to_units * nodes.blob(i);
    sources[s] = {{static_cast<Real>(y.x), static_cast<Real>(y.y), static_cast<Real>(y.z)},
                  {static_cast<Real>(nodes.force(i, 0)), static_cast<Real>(nodes.force(i, 1)),
                   static_cast<Real>(nodes.force(i, 2))},
                  static_cast<Real>(blob * blob)};
  }
}

/// potential[plane][n_padded] += field of some sources at the surface of that size; packs of points in registers.
template <int packs, class Real, class Field>
void add_potentials(const Field& field, const OperatorSet<Real>& operators, const Real size, const int first,
                    const FarSource<Real>* sources, const int n_sources, Real* potential) {
  constexpr int width = simd::width<Real>;
  Pack<Real> x[packs][3], sum[packs][Field::n_planes] = {};
  for (int k = 0; k < packs; ++k)
    for (int c = 0; c < 3; ++c) x[k][c] = size * simd::load_pack(&operators.surface(first + k * width, c));
  for (int s = 0; s < n_sources; ++s) SKEIN_UNROLL
  for (int k = 0; k < packs; ++k) field.add_source(x[k][0], x[k][1], x[k][2], sources[s], sum[k]);
  for (int k = 0; k < packs; ++k)
    for (int plane = 0; plane < Field::n_planes; ++plane) {
      Real* const at = potential + plane * operators.n_padded + first + k * width;
      simd::store_pack(at, simd::load_pack(at) + sum[k][plane]);
    }
}

template <class Real, class Field>
void add_run_potentials(const SortedNodes& nodes, const IndexRange run, const Vec3 center, const double half_width,
                        const Field& field, const OperatorSet<Real>& operators, const double size, Real* potential) {
  constexpr int width = simd::width<Real>;
  FarSource<Real> sources[tile];
  for (int first = 0; first < run.count; first += tile) {
    const int count = math::smaller(tile, run.count - first);
    load_far_sources(nodes, run.first + first, count, center, half_width, sources);
    int i = 0;
    for (; i + 2 * width <= operators.n_padded; i += 2 * width)
      add_potentials<2>(field, operators, static_cast<Real>(size), i, sources, count, potential);
    for (; i < operators.n_padded; i += width)
      add_potentials<1>(field, operators, static_cast<Real>(size), i, sources, count, potential);
  }
}

/// Sources of leaves to their coefficients (P2M); zero for other boxes.
template <class Real, class Field>
void run_p2m(const Octree& tree, const SortedNodes& nodes, const Field& field,
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
    add_run_potentials(nodes, box.sources, tree.center(box), half_width, field.at(half_width), operators, outer_surface,
                       potential.get());
    operators.to_source.apply(potential.get(), operators.to_source.n_columns, Field::n_columns, own,
                              coefficients.stride);
  }
}

/// column <- from with the signs of a reflection; the fourth column of the harmonic field (psi, measured from the box's
/// centre) is moved to the centre of the other box: to = scale * psi + shift . phi.
template <class Field, class Real>
void gather(const Real* from, const int stride, const int n, const Real* sign, const Real scale, const Real (&shift)[3],
            Real* to, const int to_stride) {
  if constexpr (Field::shifts) {
    for (int i = 0; i < n; ++i) {
      const Real x = from[i], y = from[i + stride], z = from[i + 2 * stride], psi = from[i + 3 * stride];
      to[i] = sign[i] * x;
      to[i + to_stride] = sign[i] * y;
      to[i + 2 * to_stride] = sign[i] * z;
      to[i + 3 * to_stride] = sign[i] * (scale * psi + shift[0] * x + shift[1] * y + shift[2] * z);
    }
  } else {
    for (int column = 0; column < Field::n_columns; ++column)
      for (int i = 0; i < n; ++i) to[i + column * to_stride] = sign[i] * from[i + column * stride];
  }
}

template <class Field, class Real>
void scatter(const Real* from, const int from_stride, const int n, const Real* sign, Real* to, const int stride) {
  for (int column = 0; column < Field::n_columns; ++column)
    for (int i = 0; i < n; ++i) to[i + column * stride] += sign[i] * from[i + column * from_stride];
}

constexpr int columns_at_once = 64;

/// One product for several pairs of boxes that share an operator, up to reflections.
template <class Real, class Field>
class PairBatch {
 public:
  PairBatch(const int depth, const int n_rows)
      : stride_(padded<Real>(depth)),
        out_stride_(n_rows),
        in_(stride_ * columns_at_once),
        middle_(stride_ * columns_at_once),
        out_(out_stride_ * columns_at_once) {}

  static constexpr int capacity = columns_at_once / Field::n_columns;
  bool is_full() const { return n_pairs_ == capacity; }

  void add(const Real* from, const int from_stride, const int depth, const Real* sign_in, const Real scale,
           const Real (&shift)[3], Real* to, const Real* sign_out) {
    gather<Field>(from, from_stride, depth, sign_in, scale, shift, in_.get() + n_pairs_ * Field::n_columns * stride_,
                  stride_);
    to_[n_pairs_] = to;
    sign_out_[n_pairs_++] = sign_out;
  }

  void apply(const PaddedMatrix<Real>& matrix, const int to_stride) {
    if (n_pairs_ == 0) return;
    matrix.apply(in_.get(), stride_, n_pairs_ * Field::n_columns, out_.get(), out_stride_);
    scatter_all(matrix.n_rows, to_stride);
  }
  void apply(const FactoredMatrix<Real>& matrix, const int to_stride) {
    if (n_pairs_ == 0) return;
    matrix.apply(in_.get(), stride_, n_pairs_ * Field::n_columns, middle_.get(), out_.get(), out_stride_);
    scatter_all(matrix.last.n_rows, to_stride);
  }

 private:
  void scatter_all(const int n_rows, const int to_stride) {
    for (int k = 0; k < n_pairs_; ++k)
      scatter<Field>(out_.get() + k * Field::n_columns * out_stride_, out_stride_, n_rows, sign_out_[k], to_[k],
                     to_stride);
    n_pairs_ = 0;
  }

  int stride_, out_stride_;
  HostScratch<Real> in_, middle_, out_;  ///< a factored matrix is never thicker in the middle
  Real* to_[capacity];
  const Real* sign_out_[capacity];
  int n_pairs_ = 0;
};

/// The branches of a tree: everything below (and with) one box of a level that has a few for every thread. A branch's
/// boxes of each level stand together, and branches do not meet, so that one parallel loop over branches does all their
/// levels; the few boxes above are left to one thread. Which level it is changes no result.
struct Branches {
  explicit Branches(const Octree& tree) : level(first_far_level) {
    const int wanted = 8 * HostSpace().concurrency();
    for (int l = first_far_level; l < tree.n_levels() && tree.level(level).count < wanted; ++l)
      if (tree.level(l).count > tree.level(level).count) level = l;
    roots = tree.level(level);
  }
  /// The boxes of a branch, level by level.
  static std::vector<IndexRange> boxes_of(const Octree& tree, const int root) {
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
void run_m2m(const Octree& tree, const std::vector<const OperatorSet<Real>*>& levels,
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
void compute_source_coefficients(const Octree& tree, const SortedNodes& nodes, const Field& field,
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

/// Boxes whose V lists make one task: of one level.
std::vector<IndexRange> make_transfer_tasks(const Octree& tree) {
  constexpr int min_pairs = 48, max_boxes = 64;
  std::vector<IndexRange> tasks;
  for (int level = first_far_level; level < tree.n_levels(); ++level) {
    const IndexRange boxes = tree.level(level);
    IndexRange task{boxes.first, 0};
    int n_pairs = 0;
    const int enough =
        math::larger(min_pairs, (tree.v_list().first[static_cast<std::size_t>(boxes.first + boxes.count)] -
                                 tree.v_list().first[static_cast<std::size_t>(boxes.first)]) /
                                    16);
    for (int b = boxes.first; b < boxes.first + boxes.count; ++b) {
      ++task.count;
      n_pairs += tree.v_list().size(b);
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
void run_m2l_and_p2l(const Octree& tree, const SortedNodes& nodes, const Field& field,
                     const std::vector<const OperatorSet<Real>*>& levels, const Coefficients<Real>& coefficients) {
  const std::vector<IndexRange> tasks = make_transfer_tasks(tree);
  const auto across = [&](const int t) {
    const IndexRange boxes = tasks[static_cast<std::size_t>(t)];
    const int level = tree.box(boxes.first).level;
    const auto& operators = operators_of(levels, level);
    Real* const all = coefficients.target.data();
    const std::ptrdiff_t size = coefficients.box_size;
    std::fill(all + boxes.first * size, all + (boxes.first + boxes.count) * size, Real(0));

    // Pairs in the order of their transfer vectors, and of the lists among equals.
    const FarPair* const pairs = tree.v_list().begin(boxes.first);
    const int n_pairs = static_cast<int>(tree.v_list().end(boxes.first + boxes.count - 1) - pairs);
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
      if (tree.x_list().size(b) == 0) continue;
      const double half_width = tree.half_width(level);
      const int n_values = Field::n_planes * operators.n_padded;
      const HostScratch<Real> potential(n_values), sum(static_cast<int>(size));
      std::fill(potential.get(), potential.get() + n_values, Real(0));
      for (const int* a = tree.x_list().begin(b); a != tree.x_list().end(b); ++a)
        add_run_potentials(nodes, tree.box(*a).sources, tree.center(tree.box(b)), half_width, field.at(half_width),
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
void run_l2l(const Octree& tree, const std::vector<const OperatorSet<Real>*>& levels,
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
void run_l2l_of_all_levels(const Octree& tree, const std::vector<const OperatorSet<Real>*>& levels,
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

}  // namespace

template <class Real, class Field>
void compute_coefficients(const Octree& tree, const SortedNodes& nodes, const Field& field,
                          const std::vector<const OperatorSet<Real>*>& levels, const Coefficients<Real>& coefficients) {
  if (tree.n_levels() <= first_far_level) return;
  compute_source_coefficients<Real, Field>(tree, nodes, field, levels, coefficients);
  run_m2l_and_p2l<Real, Field>(tree, nodes, field, levels, coefficients);
  run_l2l_of_all_levels<Real, Field>(tree, levels, coefficients);
}

#define SKEIN_INSTANTIATE(Real, Field)                                                             \
  template void compute_coefficients<Real, Field>(const Octree&, const SortedNodes&, const Field&, \
                                                  const std::vector<const OperatorSet<Real>*>&,    \
                                                  const Coefficients<Real>&);
SKEIN_INSTANTIATE(double, HarmonicField)
SKEIN_INSTANTIATE(float, HarmonicField)
SKEIN_INSTANTIATE(double, StokesletField)
SKEIN_INSTANTIATE(float, StokesletField)
SKEIN_INSTANTIATE(double, RegularizedField)
SKEIN_INSTANTIATE(float, RegularizedField)

}  // namespace skein
