#include <skein/arrays/launch.hpp>

#include "force_table.hpp"
#include "loaded_sections.hpp"
#include "motion_times.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace skein {
namespace {

/// A torque that may turn about an axis at a constant rate.
struct Torque {
  Vec3 start, angular_velocity;

  /// Rodrigues' formula.
  KOKKOS_INLINE_FUNCTION Vec3 at(const double time) const {
    const double rate = norm(angular_velocity);
    if (!(rate > 0.0)) return start;
    const Vec3 axis = angular_velocity / rate;
    const double c = math::cos(rate * time), s = math::sin(rate * time);
    return c * start + s * cross(axis, start) + ((1.0 - c) * dot(axis, start)) * axis;
  }
  bool is_steady() const { return cross(angular_velocity, start) == Vec3{}; }
};

/// Inertia of a section's nodes about their centroid, each of mass 1, and how it changes with displacements.
struct Inertia {
  Vec3 diagonal, mixed;  ///< xx, yy, zz and yz, xz, xy

  KOKKOS_INLINE_FUNCTION void add(const Vec3 r, const Vec3 v) {
    const double both = 2.0 * dot(r, v);
    diagonal = diagonal + Vec3{both - 2.0 * r.x * v.x, both - 2.0 * r.y * v.y, both - 2.0 * r.z * v.z};
    mixed = mixed - Vec3{r.y * v.z + r.z * v.y, r.x * v.z + r.z * v.x, r.x * v.y + r.y * v.x};
  }
  KOKKOS_INLINE_FUNCTION Vec3 multiply(const Vec3 v) const {
    return {diagonal.x * v.x + mixed.z * v.y + mixed.y * v.z, mixed.z * v.x + diagonal.y * v.y + mixed.x * v.z,
            mixed.y * v.x + mixed.x * v.y + diagonal.z * v.z};
  }
  /// By cofactors; zero where all nodes lie on a line, which no torque turns.
  KOKKOS_INLINE_FUNCTION Vec3 solve(const Vec3 right) const {
    const Vec3 a{diagonal.x, mixed.z, mixed.y}, b{mixed.z, diagonal.y, mixed.x}, c{mixed.y, mixed.x, diagonal.z};
    const double determinant = dot(a, cross(b, c));
    if (!(determinant > 0.0)) return {};
    return (right.x * cross(b, c) + right.y * cross(c, a) + right.z * cross(a, b)) / determinant;
  }
};

KOKKOS_INLINE_FUNCTION Inertia inertia_of(const LoadedSection& section, const ConstVectors& position,
                                          const Vec3 centroid) {
  Inertia inertia;
  for (int node = section.first_node; node < section.first_node + section.n_nodes; ++node) {
    const Vec3 r = load(position, node) - centroid;
    inertia.add(r, 0.5 * r);
  }
  return inertia;
}

/// The torque on a section.
KOKKOS_INLINE_FUNCTION Vec3 sum_of(const LoadedSections<Torque>& loads, const LoadedSection& section,
                                   const double time) {
  Vec3 sum;
  for (int i = section.first_load; i < section.end_load; ++i) sum = sum + loads.load(i).at(time);
  return sum;
}

/// Torques on sections, as forces alpha x (x - centroid) on their nodes with I alpha = torque: they have no sum, and
/// turn a section as a rigid body would be turned.
class Torques final : public Force {
 public:
  Torques(const std::vector<TorqueConfig>& configs, const std::vector<Fiber>& fibers, const double viscosity)
      : loads_(make_loaded_sections<Torque>("torque", configs, fibers,
                                            [](const TorqueConfig& config, const Fiber&) {
                                              return Torque{config.torque, config.angular_velocity};
                                            })),
        time_scale_(find_torque_time(configs, fibers, viscosity)),
        power_("skein::Torques::power", static_cast<std::size_t>(loads_.n_sections())) {
    for (const TorqueConfig& config : configs) {
      if (Torque{config.torque, config.angular_velocity}.is_steady()) continue;
      is_steady_ = false;
      fastest_turn_ = std::max(fastest_turn_, norm(config.angular_velocity));
    }
  }

  ForcePromises promises() const override { return {.is_balanced = true, .is_steady = is_steady_, .reach = 0}; }

  void add_forces(const double time, const ConstVectors& position, const Vectors& force) const override {
    const LoadedSections<Torque> loads = loads_;
    launch<ExecSpace>(
        "skein::add_torque_forces", ExecSpace(), Calls{loads.n_sections(), 50.0}, KOKKOS_LAMBDA(const int s) {
          const LoadedSection& section = loads.section(s);
          const Vec3 centroid = section.mean(position);
          const Vec3 alpha = inertia_of(section, position, centroid).solve(sum_of(loads, section, time));
          for (int node = section.first_node; node < section.first_node + section.n_nodes; ++node)
            store(force, node, load(force, node) + cross(alpha, load(position, node) - centroid));
        });
  }

  void add_force_changes(const double time, const ConstVectors& position, const ConstVectors& displacement,
                         const Vectors& change) const override {
    const LoadedSections<Torque> loads = loads_;
    launch<ExecSpace>(
        "skein::add_torque_force_changes", ExecSpace(), Calls{loads.n_sections(), 50.0}, KOKKOS_LAMBDA(const int s) {
          const LoadedSection& section = loads.section(s);
          const Vec3 centroid = section.mean(position), drift = section.mean(displacement);
          const Inertia inertia = inertia_of(section, position, centroid);
          const Vec3 alpha = inertia.solve(sum_of(loads, section, time));
          Inertia slope;
          for (int node = section.first_node; node < section.first_node + section.n_nodes; ++node)
            slope.add(load(position, node) - centroid, load(displacement, node) - drift);
          const Vec3 alpha_change = inertia.solve(-slope.multiply(alpha));
          for (int node = section.first_node; node < section.first_node + section.n_nodes; ++node) {
            const Vec3 r = load(position, node) - centroid, v = load(displacement, node) - drift;
            store(change, node, load(change, node) + cross(alpha_change, r) + cross(alpha, v));
          }
        });
  }

  // There is no energy of which these forces are the gradient: their work comes from outside.
  void add_drive_powers(const double time, const ConstVectors& position, const ConstVectors& velocity,
                        std::vector<double>& power) const override {
    const LoadedSections<Torque> loads = loads_;
    const FoundReals of_section = power_;
    launch<ExecSpace>(
        "skein::compute_torque_power", ExecSpace(), Calls{loads.n_sections(), 50.0}, KOKKOS_LAMBDA(const int s) {
          const LoadedSection& section = loads.section(s);
          const Vec3 centroid = section.mean(position);
          const Vec3 alpha = inertia_of(section, position, centroid).solve(sum_of(loads, section, time));
          double sum = 0.0;
          for (int node = section.first_node; node < section.first_node + section.n_nodes; ++node)
            sum += dot(cross(alpha, load(position, node) - centroid), load(velocity, node));
          of_section(s) = sum;
        });
    wait_for(ExecSpace());
    add_by_fibers(loads, of_section, power);
  }

  double time_scale() const override { return time_scale_; }
  void add_course(TimeCourse& course) const override { add_endless_oscillation(course, fastest_turn_); }

  std::string describe() const override {
    return fmt::format("{} {} torque{} on sections", loads_.n_loads(), is_steady_ ? "constant" : "turning",
                       loads_.n_loads() == 1 ? "" : "s");
  }

 private:
  LoadedSections<Torque> loads_;
  double time_scale_;
  FoundReals power_;  ///< [n_sections]
  bool is_steady_ = true;
  double fastest_turn_ = 0.0;  ///< radians / time
};

}  // namespace

void append_torques(const SceneConfig& scene, const std::vector<Fiber>& fibers, ForceList& forces) {
  refuse_lines("torque", "no torque turns; take a tube, or [[tether]]s that pull at two sections", scene.torques,
               fibers);
  if (!scene.torques.empty()) forces.push_back(std::make_unique<Torques>(scene.torques, fibers, scene.fluid.viscosity));
}

}  // namespace skein
