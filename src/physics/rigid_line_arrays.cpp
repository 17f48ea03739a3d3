#include "rigid_line_arrays.hpp"

#include "device_list.hpp"
#include "rigid_line.hpp"

#include <algorithm>
#include <utility>

namespace skein {
namespace {

/// Appends a line's numbers to the lists of all.
struct LineLists {
  std::vector<double> place, slide, shift, turn, across, along_excess;

  void append(const RigidLine& line) {
    const auto add = [](std::vector<double>& all, const std::vector<double>& more) {
      all.insert(all.end(), more.begin(), more.end());
    };
    add(place, line.place);
    add(slide, line.slide);
    add(shift, line.shift);
    add(turn, line.turn);
    add(across, line.across);
    add(along_excess, line.along_excess);
  }
};

bool are_alike(const Fiber& a, const Fiber& b) {
  return a.n_nodes() == b.n_nodes() && a.spacing() == b.spacing() && a.config.radius == b.config.radius &&
         a.config.blob == b.config.blob;
}

}  // namespace

RigidLineArrays make_rigid_line_arrays(const std::vector<Fiber>& fibers, const double viscosity) {
  LineLists lists;
  std::vector<std::pair<Fiber, RigidBody>> kinds;
  std::vector<RigidBody> bodies;
  std::vector<int> body_of_node(static_cast<std::size_t>(count_nodes(fibers)), -1);
  for (const Fiber& fiber : fibers) {
    if (!fiber.config.is_rigid()) continue;
    auto kind = std::find_if(kinds.begin(), kinds.end(), [&](const auto& k) { return are_alike(k.first, fiber); });
    if (kind == kinds.end()) {
      const RigidBody fresh{0, fiber.n_nodes(), static_cast<int>(lists.place.size()),
                            static_cast<std::int64_t>(lists.across.size())};
      lists.append(make_rigid_line(fiber, viscosity));
      kind = kinds.insert(kinds.end(), {fiber, fresh});
    }
    std::fill_n(body_of_node.begin() + fiber.first_node, fiber.n_nodes(), static_cast<int>(bodies.size()));
    bodies.push_back(kind->second);
    bodies.back().first_node = fiber.first_node;
  }
  RigidLineArrays arrays;
  arrays.body = copy_to_device("skein::RigidBodies::body", bodies);
  arrays.body_of_node = copy_to_device("skein::RigidBodies::body_of_node", body_of_node);
  arrays.place = to_device("skein::RigidBodies::place", lists.place);
  arrays.slide = to_device("skein::RigidBodies::slide", lists.slide);
  arrays.shift = to_device("skein::RigidBodies::shift", lists.shift);
  arrays.turn = to_device("skein::RigidBodies::turn", lists.turn);
  arrays.across = to_device("skein::RigidBodies::across", lists.across);
  arrays.along_excess = to_device("skein::RigidBodies::along_excess", lists.along_excess);
  for (const double drag : lists.across) arrays.stiffest_drag = std::max(arrays.stiffest_drag, drag);
  arrays.of_middle = Vectors("skein::RigidBodies::of_middle", bodies.size());
  arrays.per_place = Vectors("skein::RigidBodies::per_place", bodies.size());
  return arrays;
}

}  // namespace skein
