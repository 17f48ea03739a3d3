#pragma once

#include "fmm/box_sums.hpp"
#include "fmm/fmm_operator_set.hpp"
#include "fmm/passes.hpp"

#include <cstddef>

// The passes over boxes, each the work of a worker for some boxes: a team of a device has one box, a host's thread has
// several. Every number is a sum in the order of the lists, whoever works. Workers offer
//   rank(), size(), barrier()             of the threads that share the work
//   array<T>(n)                           memory until the work is done
//   add_potentials(...)                   of a run of sources at a surface
//   multiply<n_columns>(matrix, b, stride, write)
//   batch<Real, Field, most_pairs>(n_in, n_out)  products of an operator with the coefficients of several boxes

namespace skein {

/// to[row] = product.
template <class Real>
struct StoreProduct {
  Real* to;
  int stride;
  template <int n_columns>
  SKEIN_FORMULA void operator()(const int row, const Real (&sum)[n_columns]) const {
    for (int column = 0; column < n_columns; ++column) to[row + column * stride] = sum[column];
  }
};

/// to[row] += product.
template <class Real>
struct AddProduct {
  Real* to;
  int stride;
  template <int n_columns>
  SKEIN_FORMULA void operator()(const int row, const Real (&sum)[n_columns]) const {
    for (int column = 0; column < n_columns; ++column) to[row + column * stride] += sum[column];
  }
};

template <class Worker, class Real>
SKEIN_FORMULA void fill_zeros(const Worker& worker, Real* to, const int n) {
  for (int i = worker.rank(); i < n; i += worker.size()) to[i] = Real(0);
}

/// Sources of leaves to their coefficients (P2M); zero for other boxes.
template <class Space, class Real, class Field>
struct SourcesToLeaves {
  Passes<Space, Real, Field> passes;

  SKEIN_FORMULA int n_values() const { return Field::n_planes * passes.levels.n_padded; }
  template <class Workers>
  std::size_t scratch_bytes() const {
    return Workers::template array_bytes<Real>(n_values()) +
           Workers::template array_bytes<FarSource<Real>>(source_tile);
  }
  template <class Worker>
  SKEIN_FORMULA void operator()(const Worker& worker, const IndexRange boxes) const {
    const int n = n_values();
    const auto potential = worker.template array<Real>(n);
    const auto tile = worker.template array<FarSource<Real>>(source_tile);
    for (int b = boxes.first; b < boxes.first + boxes.count; ++b) {
      const Box& box = passes.boxes(b);
      if (!box.is_leaf() || box.sources.count == 0) {
        fill_zeros(worker, passes.source_of(b), passes.coefficients.box_size);
        continue;
      }
      const LevelOperators<Real>& operators = passes.operators_of(box);
      fill_zeros(worker, potential.data(), n);
      const double half_width = passes.cube.half_width(box.level);
      worker.add_potentials(passes.nodes, box.sources, passes.cube.center(box), half_width, passes.field.at(half_width),
                            operators, static_cast<Real>(outer_surface), tile.data(), potential.data());
      worker.barrier();  // potentials are complete
      worker.template multiply<Field::n_columns>(operators.to_source, potential.data(), operators.to_source.n_columns,
                                                 StoreProduct<Real>{passes.source_of(b), passes.coefficients.stride});
    }
  }
};

/// Children to parents of one level (M2M), child by child.
template <class Space, class Real, class Field>
struct ChildrenToParents {
  static constexpr int most_pairs = 8 / Field::n_columns;
  Passes<Space, Real, Field> passes;

  template <class Workers>
  std::size_t scratch_bytes() const {
    return Workers::template batch_bytes<Real, Field, most_pairs>(passes.coefficients.stride);
  }
  template <class Worker>
  SKEIN_FORMULA void operator()(const Worker& worker, const IndexRange parents) const {
    const int stride = passes.coefficients.stride, level = passes.boxes(parents.first).level;
    if (level + 1 >= passes.n_levels) return;
    const LevelOperators<Real>& own = passes.levels.sets(level);
    const LevelOperators<Real>& below = passes.levels.sets(level + 1);
    auto batch = worker.template batch<Real, Field, most_pairs>(below.rank_padded, own.rank_padded);
    for (int p = parents.first; p < parents.first + parents.count; ++p) {
      const Box& parent = passes.boxes(p);
      for (int child = parent.first_child; child < parent.first_child + parent.n_children; ++child) {
        const Box& box = passes.boxes(child);
        if (box.sources.count == 0) continue;
        // In the parent's units the child's centre is half a unit off along each axis, and psi half as large.
        Real shift[3]{};
        for (int c = 0; c < 3; ++c) shift[c] = Real(0.5) * Real(child_side(box.octant, c));
        const int reflected = 7 & ~box.octant;
        batch.add(passes.source_of(child), stride, below.rank_padded, below.sign_of(reflected), Real(0.5), shift,
                  passes.source_of(p), own.sign_of(reflected));
        if (batch.is_full()) batch.apply(own.to_parent, stride);
      }
    }
    batch.apply(own.to_parent, stride);
  }
};

/// Sources of X lists to the coefficients for targets (P2L).
template <class Space, class Real, class Field>
struct SourcesToTargets {
  Passes<Space, Real, Field> passes;

  template <class Workers>
  std::size_t scratch_bytes() const {
    return SourcesToLeaves<Space, Real, Field>{passes}.template scratch_bytes<Workers>();
  }
  template <class Worker>
  SKEIN_FORMULA void operator()(const Worker& worker, const IndexRange boxes) const {
    const int n = Field::n_planes * passes.levels.n_padded;
    const auto potential = worker.template array<Real>(n);
    const auto tile = worker.template array<FarSource<Real>>(source_tile);
    for (int b = boxes.first; b < boxes.first + boxes.count; ++b) {
      const int first = passes.x_list.first(b), last = passes.x_list.first(b + 1);
      if (first == last) continue;
      const Box& box = passes.boxes(b);
      const LevelOperators<Real>& operators = passes.operators_of(box);
      const double half_width = passes.cube.half_width(box.level);
      fill_zeros(worker, potential.data(), n);
      for (int k = first; k < last; ++k)
        worker.add_potentials(passes.nodes, passes.boxes(passes.x_list.entries(k)).sources, passes.cube.center(box),
                              half_width, passes.field.at(half_width), operators, static_cast<Real>(inner_surface),
                              tile.data(), potential.data());
      worker.barrier();  // potentials are complete
      worker.template multiply<Field::n_columns>(operators.to_target, potential.data(), operators.to_target.n_columns,
                                                 AddProduct<Real>{passes.target_of(b), passes.coefficients.stride});
    }
  }
};

/// Parents to children of one level (L2L).
template <class Space, class Real, class Field>
struct ParentsToChildren {
  Passes<Space, Real, Field> passes;

  template <class Workers>
  std::size_t scratch_bytes() const {
    return Workers::template batch_bytes<Real, Field, 1>(passes.coefficients.stride);
  }
  template <class Worker>
  SKEIN_FORMULA void operator()(const Worker& worker, const IndexRange boxes) const {
    const int stride = passes.coefficients.stride, level = passes.boxes(boxes.first).level;
    const LevelOperators<Real>& own = passes.levels.sets(level);
    const LevelOperators<Real>& above = passes.levels.sets(level - 1);
    auto batch = worker.template batch<Real, Field, 1>(above.rank_padded, own.rank_padded);
    for (int b = boxes.first; b < boxes.first + boxes.count; ++b) {
      const Box& box = passes.boxes(b);
      if (box.targets.count == 0) continue;
      Real shift[3]{};
      for (int c = 0; c < 3; ++c) shift[c] = Real(-child_side(box.octant, c));
      const int reflected = 7 & ~box.octant;
      batch.add(passes.target_of(box.parent), stride, above.rank_padded, above.sign_of(reflected), Real(2), shift,
                passes.target_of(b), own.sign_of(reflected));
      if (batch.is_full()) batch.apply(above.to_child, stride);
    }
    batch.apply(above.to_child, stride);
  }
};

}  // namespace skein
