#pragma once

#include <skein/physics/force.hpp>

/// The same force on every node, in all directions of one's choice: the smallest force that there is. Arrays lie where
/// kernels run; a named functor, not a lambda, because an extended lambda may not stand in a header.
class SettlingWeight final : public skein::Force {
 public:
  explicit SettlingWeight(const skein::Vec3 per_node) : per_node_(per_node) {}

  skein::ForcePromises promises() const override { return {.is_steady = true}; }

  void add_forces(double /*time*/, const skein::ConstVectors& position, const skein::Vectors& force) const override {
    Kokkos::parallel_for("example::SettlingWeight", Kokkos::RangePolicy<skein::ExecSpace>(0, position.extent_int(0)),
                         Add{per_node_, force});
  }

  // It is the same wherever nodes are.
  void add_force_changes(double, const skein::ConstVectors&, const skein::ConstVectors&,
                         const skein::Vectors&) const override {}

  std::string describe() const override { return "a weight on every node"; }

 private:
  struct Add {
    skein::Vec3 weight;
    skein::Vectors force;
    KOKKOS_FUNCTION void operator()(const int i) const { skein::store(force, i, skein::load(force, i) + weight); }
  };
  skein::Vec3 per_node_;
};
