#pragma once

#include "fmm/laplace.hpp"
#include "fmm/level_operators.hpp"
#include "fmm/sorted_nodes.hpp"

#include <functional>
#include <vector>

namespace skein {

/// Coefficients of all boxes: [n_boxes][n_columns][stride].
template <class Space, class Real>
struct Coefficients {
  Kokkos::View<Real*, Space> source, target;
  int stride = 0;    ///< of a column: the largest padded rank of all levels
  int box_size = 0;  ///< n_columns * stride

  double bytes() const { return static_cast<double>(sizeof(Real) * (source.size() + target.size())); }
};

/// What the passes over a tree read and write, by value for kernels.
template <class Space, class Real, class Field>
struct Passes {
  Passes(const Octree<Space>& tree, const SortedNodes<Space>& sorted, const Field& far_field,
         const Levels<Space, Real>& operators, const Coefficients<Space, Real>& of_boxes)
      : cube(tree.cube),
        n_levels(tree.n_levels()),
        n_boxes(tree.n_boxes()),
        boxes(tree.boxes),
        v_list(tree.v_list),
        x_list(tree.x_list),
        u_list(tree.u_list),
        w_list(tree.w_list),
        target_leaves(tree.target_leaves),
        near_end(tree.near_end),
        target_order(tree.target_order()),
        nodes(sorted),
        field(far_field),
        levels(operators),
        coefficients(of_boxes) {}

  OctreeCube cube;
  int n_levels, n_boxes;
  Kokkos::View<const Box*, Space> boxes;
  Lists<FarPair, Space> v_list;
  Lists<int, Space> x_list;
  Lists<IndexRange, Space> u_list;
  Lists<int, Space> w_list;
  Kokkos::View<const int*, Space> target_leaves, near_end, target_order;
  SortedNodes<Space> nodes;
  Field field;
  Levels<Space, Real> levels;
  Coefficients<Space, Real> coefficients;

  SKEIN_FORMULA const LevelOperators<Real>& operators_of(const Box& box) const { return levels.sets(box.level); }
  SKEIN_FORMULA Real* source_of(const int b) const {
    return coefficients.source.data() + static_cast<std::ptrdiff_t>(b) * coefficients.box_size;
  }
  SKEIN_FORMULA Real* target_of(const int b) const {
    return coefficients.target.data() + static_cast<std::ptrdiff_t>(b) * coefficients.box_size;
  }
};

/// Which boxes a process passes over: all of a tree, or its share where others have theirs.
struct PassedBoxes {
  std::vector<IndexRange> sources, targets;  ///< per level
  std::vector<int> of_all;                   ///< last ones of the way up, which follow the exchange
  std::function<void()> exchange;            ///< of coefficients with others; empty: nobody else
};

}  // namespace skein
