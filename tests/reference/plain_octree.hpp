#pragma once

#include "fmm/octree_cube.hpp"

#include <vector>

namespace skein::reference {

/// An octree by its definition, box by box on one thread, its lists by trying all pairs of boxes: for what the builder
/// by sorted keys is compared with. Nodes of a box stand in no particular order.
struct PlainOctree {
  struct PlainBox {
    int level = 0, parent = -1, octant = 0;
    int cell[3] = {};
    std::vector<int> sources, targets;  ///< indices in the caller's arrays
    std::vector<int> children;
    bool is_leaf() const { return children.empty(); }
  };

  /// @param cube  where the root lies and what is split
  PlainOctree(const OctreeCube& cube, const std::vector<Vec3>& source, const std::vector<Vec3>& target);

  /// Lists of the fast multipole method, of boxes, ascending. Where fewer nodes than `fewest` would be expanded, leaves
  /// meet one by one.
  std::vector<int> far(int b) const;                        ///< V
  std::vector<int> coarse(int b, int fewest) const;         ///< X
  std::vector<int> fine(int leaf, int fewest) const;        ///< W
  std::vector<int> one_by_one(int leaf, int fewest) const;  ///< U: boxes whose sources the leaf meets one by one

  std::vector<PlainBox> boxes;  ///< level by level, in the order of their parents and octants

 private:
  bool touch(int a, int b) const;
  bool is_met_coarse(int b, int leaf) const;
};

}  // namespace skein::reference
