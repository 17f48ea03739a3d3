#include "fmm/octree_cube.hpp"

#include <algorithm>
#include <cmath>

namespace skein {
namespace {

constexpr int n_sampled = 4096;

struct CellChoice {
  double side;
  int nodes_per_cell;
  double dimension;  ///< 1 for a line, 3 for a cloud
};

/// Side of the cells that would hold the aimed number of nodes each on average, from a sample: the mean number of nodes
/// per occupied cell as a function of the cell's side, interpolated; where the sample is too thin, extrapolated by the
/// dimension that the coarser cells show (1 for a line, 3 for a cloud). Along a line leaf_size nodes are aimed at; in a
/// cloud, where a box has 189 far pairs instead of three, twice as many.
CellChoice choose_cell(const int n, const double (&corner)[3], const double side, const int leaf_size,
                       const SampleCells& sample) {
  // Enough to see cells of an eighth of what is aimed at: there a thick line has split across its width, too.
  const std::int64_t n_wanted = std::max<std::int64_t>(n_sampled, std::int64_t{12} * n / leaf_size);
  const int stride = math::larger(1, static_cast<int>(n / n_wanted));
  const SampledCells sampled = sample(make_key_of(corner, side, max_key_depth), stride);
  double slope = 1.0;  // log2 of the growth of the number of cells per level
  double cells = 1.0;
  for (int level = 1; level <= max_key_depth; ++level) {
    const double finer = cells + sampled.n_new_cells[level];
    const bool is_thin = sampled.n_keys < 1.5 * finer;
    if (!is_thin) slope = std::clamp(std::log2(finer / cells), 0.5, 3.0);
    const double aimed = leaf_size * std::exp2(0.5 * std::max(0.0, slope - 1.0));
    const double needed = static_cast<double>(n) / aimed / cells;  // more cells than there are here, a factor
    if (is_thin || finer / cells >= needed) {
      const double coarse = side / static_cast<double>(1 << (level - 1));
      return {needed <= 1.0 ? coarse : coarse * std::exp2(-std::log2(needed) / slope), static_cast<int>(aimed), slope};
    }
    cells = finer;
  }
  return {side / static_cast<double>(1 << max_key_depth), leaf_size, 1.0};
}

/// Sides change in steps of a quarter octave, so that operators that depend on them can be kept while nodes move.
double quantized(const double side) { return std::exp2(0.25 * std::floor(4.0 * std::log2(side))); }

/// The least side of cells that is worth its cost: the easy one, or a smaller one where near pairs would cost more than
/// all that small leaves take.
/// @param smallest  side of a cell that may be, length  @param extent  of all n nodes, length
double find_worthy_side(const CellChoice& choice, const double smallest, const double extent, const int n,
                        const OctreeRules& rules) {
  constexpr double gain = 0.95;  // that small leaves must have, because estimates are rough
  const double easy = std::max(smallest, 2.0 * rules.easy_half_width), s = choice.dimension;
  const double n_touching = std::pow(3.0, s), n_far = std::pow(6.0, s) - n_touching,
               n_boxes = 1.0 / (1.0 - std::exp2(-s));
  const auto cost = [&](const double side) {  // of a node
    const double n_nodes = choice.nodes_per_cell * std::pow(side / choice.side, s);
    return rules.costs.near_pair * n_touching * n_nodes +
           (rules.costs.far_pair * n_far + rules.costs.box) * n_boxes / n_nodes;
  };
  double best = easy, least = gain * cost(easy);
  for (double side = std::max(smallest, choice.side); side < easy; side *= std::exp2(0.25)) {
    const double here = cost(side) + rules.costs.small_leaf_node;
    if (here >= least) continue;
    best = side;
    least = here;
  }
  // Two easy cells in a row are not far from each other: all nodes meet, and there are no expansions. For so few cells
  // small leaves are estimated too dear: without expansions, coils of 1512 nodes take 0.55 of the time and of 2880
  // 0.77, which is not seen here, but of 5418 1.2.
  const double all_near = rules.costs.near_pair * n;
  if (extent < 3.0 * easy && 1.5 * all_near < least + rules.costs.far_node) return easy;
  return best;
}

}  // namespace

KeyOf make_key_of(const double (&corner)[3], const double side, const int depth) {
  const double n_cells = static_cast<double>(1 << depth);
  return {{corner[0], corner[1], corner[2]}, n_cells / side, n_cells};
}

OctreeCube choose_octree_cube(NodeBounds bounds, const int n_nodes, const OctreeRules& rules,
                              const SampleCells& sample) {
  OctreeCube cube;
  double extent = 0.0, reach = 0.0;
  for (int c = 0; c < 3; ++c) {
    if (!(bounds.high[c] >= bounds.low[c])) bounds.low[c] = bounds.high[c] = 0.0;
    extent = std::max(extent, bounds.high[c] - bounds.low[c]);
    reach = std::max({reach, std::abs(bounds.low[c]), std::abs(bounds.high[c])});
  }
  if (!std::isfinite(extent)) extent = 1.0;
  // A cell smaller than the spacing of the numbers themselves is no cell.
  extent = std::max({extent, 1e-10 * reach, 1e-300}) * (1.0 + 1e-6);
  double smallest = std::max(2.0 * rules.min_half_width, 1e-13 * reach);

  for (int c = 0; c < 3; ++c) cube.corner[c] = bounds.low[c];
  double cell = extent;
  cube.nodes_per_cell = rules.leaf_size;
  if (n_nodes <= rules.leaf_size) {
    smallest = std::max(smallest, 2.0 * rules.easy_half_width);
  } else {
    const CellChoice choice = choose_cell(n_nodes, cube.corner, extent, rules.leaf_size, sample);
    double worthy = smallest;
    if (rules.easy_half_width > 0.0) {
      worthy = find_worthy_side(choice, smallest, extent, n_nodes, rules);
      if (worthy >= 2.0 * rules.easy_half_width) smallest = worthy;
    }
    if (rules.has_quantized_cells) {
      cell = std::min(extent, std::max(smallest, quantized(choice.side)));
    } else {
      // A whole number of cells along the longest side: none at the rim is nearly empty.
      const double n_cells = std::min(std::round(extent / choice.side), std::floor(extent / worthy));
      cell = extent / std::max(1.0, n_cells);
    }
    cube.nodes_per_cell = choice.nodes_per_cell;
  }

  cube.side = std::max(cell, 1e-300);
  while (cube.side < extent && cube.aimed_depth < max_key_depth) {
    cube.side *= 2.0;
    ++cube.aimed_depth;
  }
  cube.max_depth = cube.aimed_depth;
  while (cube.max_depth < max_key_depth && cube.side / static_cast<double>(2 << cube.max_depth) >= smallest)
    ++cube.max_depth;

  // The finest cells that hold the whole thickness of a thin direction get their middle where its middle is: a straight
  // fiber then lies in one row of cells instead of across the planes of the octree.
  for (int c = 0; c < 3; ++c) {
    const double thickness = (bounds.high[c] - bounds.low[c]) * (1.0 + 1e-6);
    int level = 0;
    while (level < cube.max_depth && cube.side / static_cast<double>(2 << level) >= thickness) ++level;
    const double side = cube.side / static_cast<double>(1 << level);
    const double row = std::floor(0.5 * static_cast<double>(1 << level));
    if (level > 0)
      cube.corner[c] = 0.5 * (bounds.low[c] + bounds.high[c]) - (row + 0.5) * side;
    else
      cube.corner[c] = bounds.low[c] - 1e-7 * extent;
  }
  return cube;
}

}  // namespace skein
