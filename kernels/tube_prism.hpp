#pragma once

#include "kernels/triangle.hpp"
#include "kernels/tube_surface.hpp"

namespace skein {

/// One prism of a fiber's surface, seen from a point.
template <class Space>
class PrismView {
 public:
  KOKKOS_INLINE_FUNCTION PrismView(const TubeSurfaces<Space>& surfaces, const FiberSections& fiber, const int prism,
                                   const Vec3 point)
      : surfaces_(surfaces), fiber_(fiber), prism_(prism), point_(point) {}

  /// False only where the prism is farther from the point than `distance`: it is judged by the box about it, then by
  /// its extent along its axis.
  KOKKOS_INLINE_FUNCTION bool may_be_within(const double distance) const {
    if (squared_distance_to_prism(surfaces_, prism_, point_, point_) > distance * distance) return false;
    const Vec3 own = load(surfaces_.sections.centroid, prism_);
    const Vec3 axis = load(surfaces_.sections.centroid, prism_ + 1) - own;
    double low = 0.0, high = 0.0;
    const int n = fiber_.nodes_per_section;
    for (int corner = 0; corner < 2 * n; ++corner) {
      const double height = dot(load(surfaces_.position, fiber_.first_node_of(prism_) + corner) - own, axis);
      low = corner == 0 || height < low ? height : low;
      high = corner == 0 || height > high ? height : high;
    }
    const double height = dot(point_ - own, axis), slack = norm(axis) * distance;
    return height >= low - slack && height <= high + slack;
  }

  /// Of its whole surface: 4 pi from inside, 0 from outside. The faces that it shares with its neighbours are looked at
  /// as the neighbours do, in the same order of corners, so that they cancel where prisms are added up.
  KOKKOS_INLINE_FUNCTION double compute_solid_angle() const {
    double angle = fan_angle(prism_ + 1) - fan_angle(prism_);
    for_each_side([&](const Vec3 a, const Vec3 b, const Vec3 c) { angle += solid_angle(a, b, c); });
    return angle;
  }

  /// To the part of it that is the fiber's surface: the sides, and the ends of the first and the last prism.
  KOKKOS_INLINE_FUNCTION double squared_distance() const {
    double least = -1.0;
    const auto take = [&](const Vec3 a, const Vec3 b, const Vec3 c) {
      const double square = squared_distance_to_triangle(a, b, c);
      if (least < 0.0 || square < least) least = square;
    };
    for_each_side(take);
    if (prism_ == fiber_.first_section) for_each_of_fan(prism_, take);
    if (prism_ + 2 == fiber_.first_section + fiber_.n_sections) for_each_of_fan(prism_ + 1, take);
    return least;
  }

 private:
  /// From the point to a node.
  KOKKOS_INLINE_FUNCTION Vec3 node(const int section, const int place) const {
    return load(surfaces_.position, fiber_.first_node_of(section) + place) - point_;
  }

  template <class Body>
  KOKKOS_INLINE_FUNCTION void for_each_side(const Body& body) const {
    Vec3 a = node(prism_, fiber_.nodes_per_section - 1), above_a = node(prism_ + 1, fiber_.nodes_per_section - 1);
    for (int place = 0; place < fiber_.nodes_per_section; ++place) {
      const Vec3 b = node(prism_, place), above_b = node(prism_ + 1, place);
      body(a, b, above_a);
      body(b, above_b, above_a);
      a = b;
      above_a = above_b;
    }
  }

  template <class Body>
  KOKKOS_INLINE_FUNCTION void for_each_of_fan(const int section, const Body& body) const {
    const Vec3 center = load(surfaces_.sections.centroid, section) - point_;
    Vec3 a = node(section, fiber_.nodes_per_section - 1);
    for (int place = 0; place < fiber_.nodes_per_section; ++place) {
      const Vec3 b = node(section, place);
      body(center, a, b);
      a = b;
    }
  }

  KOKKOS_INLINE_FUNCTION double fan_angle(const int section) const {
    double angle = 0.0;
    for_each_of_fan(section, [&](const Vec3 a, const Vec3 b, const Vec3 c) { angle += solid_angle(a, b, c); });
    return angle;
  }

  const TubeSurfaces<Space>& surfaces_;
  const FiberSections& fiber_;
  int prism_;
  Vec3 point_;
};

}  // namespace skein
