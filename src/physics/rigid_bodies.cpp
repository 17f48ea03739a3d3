#include <skein/core/error.hpp>
#include <skein/physics/rigid_bodies.hpp>

#include "device_list.hpp"
#include "rigid_line.hpp"
#include "rigid_line_arrays.hpp"

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

void check_extent(const ConstVectors& vectors, const RigidLineArrays& lines) {
  SKEIN_REQUIRE(vectors.extent(0) == lines.body_of_node.extent(0), "vectors are those of the fibers' nodes");
}

/// Calls a kernel for each of `n`: a rigid fiber, whose nodes are taken in their order, or a node.
template <class Kernel>
void run(const char* label, const int n, const Kernel& kernel) {
  Kokkos::parallel_for(label, Kokkos::RangePolicy<ExecSpace>(ExecSpace(), 0, n), kernel);
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

RigidBodies::RigidBodies(const std::vector<Fiber>& fibers, const double viscosity)
    : lines_(std::make_unique<RigidLineArrays>(make_rigid_line_arrays(fibers, viscosity))) {
  n_bodies_ = lines_->body.extent_int(0);
}

RigidBodies::~RigidBodies() = default;
RigidBodies::RigidBodies(RigidBodies&&) noexcept = default;
RigidBodies& RigidBodies::operator=(RigidBodies&&) noexcept = default;

double RigidBodies::stiffest_drag() const { return lines_->stiffest_drag; }

RigidPoses RigidBodies::make_poses() const {
  const auto n = static_cast<std::size_t>(n_bodies_);
  return {Vectors("skein::RigidPoses::center", n), Vectors("skein::RigidPoses::axis", n)};
}

void RigidBodies::compute_poses(const ConstVectors& position, const RigidPoses& poses) const {
  check_extent(position, *lines_);
  const RigidLineArrays lines = *lines_;
  run(
      "skein::compute_rigid_poses", n_bodies_, KOKKOS_LAMBDA(const int i) {
        const RigidBody b = lines.body(i);
        Vec3 center, moment;
        for (int node = b.first_node; node < b.first_node + b.n_nodes; ++node) center = center + load(position, node);
        center = center / static_cast<double>(b.n_nodes);
        for (int node = b.first_node; node < b.first_node + b.n_nodes; ++node)
          moment = moment + lines.place(b.entry_of(node)) * (load(position, node) - center);
        store(poses.center, i, center);
        store(poses.axis, i, moment / norm(moment));
      });
}

void RigidBodies::place(const RigidPoses& poses, const Vectors& position) const {
  check_extent(position, *lines_);
  const RigidLineArrays lines = *lines_;
  run(
      "skein::place_rigid_bodies", position.extent_int(0), KOKKOS_LAMBDA(const int node) {
        const int i = lines.body_of_node(node);
        if (i < 0) return;
        store(position, node, load(poses.center, i) + lines.place(lines.body(i).entry_of(node)) * load(poses.axis, i));
      });
}

void RigidBodies::spread_loads(const RigidPoses& poses, const Vectors& force) const {
  check_extent(force, *lines_);
  const RigidLineArrays lines = *lines_;
  run(
      "skein::spread_rigid_loads", n_bodies_, KOKKOS_LAMBDA(const int i) {
        const RigidBody b = lines.body(i);
        const Vec3 axis = load(poses.axis, i);
        const BodyVectors sum = lines.load_of(b, axis, force);
        const Vec3 along = dot(axis, sum.of_middle) * axis, across = sum.of_middle - along;
        for (int node = b.first_node; node < b.first_node + b.n_nodes; ++node) {
          const int entry = b.entry_of(node);
          store(force, node,
                lines.slide(entry) * along + lines.shift(entry) * across + lines.turn(entry) * sum.per_place);
        }
      });
}

void RigidBodies::add_constraint_forces(const RigidPoses& poses, const ConstVectors& velocity,
                                        const Vectors& force) const {
  check_extent(velocity, *lines_);
  check_extent(force, *lines_);
  const RigidLineArrays lines = *lines_;
  run(
      "skein::compute_rigid_motions", n_bodies_, KOKKOS_LAMBDA(const int i) {
        const BodyVectors motion = lines.motion_in(lines.body(i), load(poses.axis, i), velocity);
        store(lines.of_middle, i, motion.of_middle);
        store(lines.per_place, i, motion.per_place);
      });
  run(
      "skein::add_rigid_constraint_forces", force.extent_int(0), KOKKOS_LAMBDA(const int node) {
        const int i = lines.body_of_node(node);
        if (i < 0) return;
        const RigidBody b = lines.body(i);
        const Vec3 axis = load(poses.axis, i), of_middle = load(lines.of_middle, i),
                   per_place = load(lines.per_place, i);
        const std::int64_t row = b.first_entry_of_matrix + static_cast<std::int64_t>(node - b.first_node) * b.n_nodes;
        Vec3 across, along;
        for (int other = 0; other < b.n_nodes; ++other) {
          const Vec3 slip =
              load(velocity, b.first_node + other) - of_middle - lines.place(b.first_entry + other) * per_place;
          across = across + lines.across(row + other) * slip;
          along = along + lines.along_excess(row + other) * slip;
        }
        store(force, node, load(force, node) - across - dot(axis, along) * axis);
      });
}

void RigidBodies::make_rigid(const RigidPoses& poses, const Vectors& velocity) const {
  check_extent(velocity, *lines_);
  const RigidLineArrays lines = *lines_;
  run(
      "skein::make_rigid", n_bodies_, KOKKOS_LAMBDA(const int i) {
        const RigidBody b = lines.body(i);
        const BodyVectors motion = lines.motion_in(b, load(poses.axis, i), velocity);
        for (int node = b.first_node; node < b.first_node + b.n_nodes; ++node)
          store(velocity, node, motion.of_middle + lines.place(b.entry_of(node)) * motion.per_place);
      });
}

void RigidBodies::compute_share(const ConstVectors& vectors, const Vectors& result) const {
  check_extent(vectors, *lines_);
  check_extent(result, *lines_);
  const RigidLineArrays lines = *lines_;
  run(
      "skein::compute_rigid_share", result.extent_int(0), KOKKOS_LAMBDA(const int node) {
        store(result, node, lines.body_of_node(node) < 0 ? Vec3{} : load(vectors, node));
      });
}

}  // namespace skein
