#include "tests/reference/plain_octree.hpp"

#include <algorithm>
#include <cmath>

namespace skein::reference {

PlainOctree::PlainOctree(const OctreeCube& cube, const std::vector<Vec3>& source, const std::vector<Vec3>& target) {
  boxes.emplace_back();
  for (std::size_t i = 0; i < source.size(); ++i) boxes[0].sources.push_back(static_cast<int>(i));
  for (std::size_t i = 0; i < target.size(); ++i) boxes[0].targets.push_back(static_cast<int>(i));
  // The cell of the finest grid, as everybody rounds it; what lies outside goes to the rim.
  const auto octant_of = [&](const Vec3& x, const int level) {
    const double n_cells = std::ldexp(1.0, cube.max_depth);
    const double position[3] = {x.x, x.y, x.z};
    int octant = 0;
    for (int c = 0; c < 3; ++c) {
      const double place = (position[c] - cube.corner[c]) * (n_cells / cube.side);
      const double cell = place > 0.0 ? std::min(std::floor(place), n_cells - 1.0) : 0.0;
      octant |= static_cast<int>(static_cast<long long>(cell) >> (cube.max_depth - level) & 1) << c;
    }
    return octant;
  };
  for (std::size_t b = 0; b < boxes.size(); ++b) {
    const PlainBox box = boxes[b];
    if (box.level == cube.max_depth ||
        static_cast<int>(std::max(box.sources.size(), box.targets.size())) <= cube.split_above(box.level))
      continue;
    for (int octant = 0; octant < 8; ++octant) {
      PlainBox child;
      child.level = box.level + 1;
      child.parent = static_cast<int>(b);
      child.octant = octant;
      for (int c = 0; c < 3; ++c) child.cell[c] = 2 * box.cell[c] + (octant >> c & 1);
      for (const int i : box.sources)
        if (octant_of(source[static_cast<std::size_t>(i)], child.level) == octant) child.sources.push_back(i);
      for (const int i : box.targets)
        if (octant_of(target[static_cast<std::size_t>(i)], child.level) == octant) child.targets.push_back(i);
      if (child.sources.empty() && child.targets.empty()) continue;
      boxes[b].children.push_back(static_cast<int>(boxes.size()));
      boxes.push_back(child);
    }
  }
}

bool PlainOctree::touch(const int a, const int b) const {
  const PlainBox &one = boxes[static_cast<std::size_t>(a)], &other = boxes[static_cast<std::size_t>(b)];
  const double side = std::ldexp(1.0, -one.level), other_side = std::ldexp(1.0, -other.level);
  for (int c = 0; c < 3; ++c)
    if (one.cell[c] * side > (other.cell[c] + 1) * other_side || (one.cell[c] + 1) * side < other.cell[c] * other_side)
      return false;
  return true;
}

std::vector<int> PlainOctree::far(const int b) const {
  std::vector<int> list;
  const PlainBox& box = boxes[static_cast<std::size_t>(b)];
  if (box.parent < 0 || box.targets.empty()) return list;
  for (int s = 0; s < static_cast<int>(boxes.size()); ++s) {
    const PlainBox& other = boxes[static_cast<std::size_t>(s)];
    if (other.level == box.level && !other.sources.empty() && !touch(b, s) && touch(box.parent, other.parent))
      list.push_back(s);
  }
  return list;
}

/// A coarser leaf that touches the parent of a box, but not the box.
bool PlainOctree::is_met_coarse(const int b, const int leaf) const {
  const PlainBox &box = boxes[static_cast<std::size_t>(b)], &other = boxes[static_cast<std::size_t>(leaf)];
  return box.parent >= 0 && other.is_leaf() && !other.sources.empty() && !box.targets.empty() &&
         other.level < box.level && touch(box.parent, leaf) && !touch(b, leaf);
}

std::vector<int> PlainOctree::coarse(const int b, const int fewest) const {
  std::vector<int> list;
  const PlainBox& box = boxes[static_cast<std::size_t>(b)];
  if (box.is_leaf() && static_cast<int>(box.targets.size()) < fewest) return list;
  for (int a = 0; a < static_cast<int>(boxes.size()); ++a)
    if (is_met_coarse(b, a)) list.push_back(a);
  return list;
}

std::vector<int> PlainOctree::fine(const int leaf, const int fewest) const {
  std::vector<int> list;
  for (int w = 0; w < static_cast<int>(boxes.size()); ++w) {
    const PlainBox& other = boxes[static_cast<std::size_t>(w)];
    if (other.level > boxes[static_cast<std::size_t>(leaf)].level && !touch(leaf, w) && touch(leaf, other.parent) &&
        !other.sources.empty() && static_cast<int>(other.sources.size()) >= fewest)
      list.push_back(w);
  }
  return list;
}

std::vector<int> PlainOctree::one_by_one(const int leaf, const int fewest) const {
  std::vector<int> list;
  const PlainBox& box = boxes[static_cast<std::size_t>(leaf)];
  for (int u = 0; u < static_cast<int>(boxes.size()); ++u) {
    const PlainBox& other = boxes[static_cast<std::size_t>(u)];
    if (other.sources.empty()) continue;
    const bool is_near = other.is_leaf() && touch(leaf, u);
    const bool is_small = other.level > box.level && !touch(leaf, u) && touch(leaf, other.parent) &&
                          static_cast<int>(other.sources.size()) < fewest;
    const bool has_few_targets = is_met_coarse(leaf, u) && static_cast<int>(box.targets.size()) < fewest;
    if (is_near || is_small || has_few_targets) list.push_back(u);
  }
  return list;
}

}  // namespace skein::reference
