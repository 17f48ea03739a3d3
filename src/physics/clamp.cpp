#include <skein/arrays/launch.hpp>
#include <skein/fibers/start_shape.hpp>

#include "force_table.hpp"
#include "loaded_sections.hpp"
#include "motion_times.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace skein {
namespace {

/// A vector turned about an axis of length 1 by an angle: Rodrigues' formula.
KOKKOS_INLINE_FUNCTION Vec3 turn_about(const Vec3 axis, const double angle, const Vec3 v) {
  const double c = math::cos(angle), s = math::sin(angle);
  return c * v + s * cross(axis, v) + ((1.0 - c) * dot(axis, v)) * axis;
}

/// A frame in which the nodes of a section have their places, each held there by a spring without a rest length.
struct Clamp {
  double stiffness = 0.0;  ///< of all springs together, force / length
  Vec3 point, swing;
  Vec3 along, angle_0, angle_90;  ///< of the section at rest
  Vec3 tilt_axis;                 ///< of length 1
  double tilt = 0.0;              ///< radians
  double angular_frequency = 0.0, spin = 0.0, radius = 0.0;

  /// From the section's middle to node `place` of n, before the frame tilts; length.
  KOKKOS_INLINE_FUNCTION Vec3 arm(const double time, const int place, const int n) const {
    const double angle = 2.0 * std::numbers::pi * place / n + spin * time;
    return (radius * math::cos(angle)) * angle_0 + (radius * math::sin(angle)) * angle_90;
  }
  KOKKOS_INLINE_FUNCTION Vec3 anchor(const double time, const int place, const int n) const {
    const double s = math::sin(angular_frequency * time);
    return point + s * swing + turn_about(tilt_axis, s * tilt, arm(time, place, n));
  }
  KOKKOS_INLINE_FUNCTION Vec3 anchor_velocity(const double time, const int place, const int n) const {
    const double s = math::sin(angular_frequency * time);
    const double rate = angular_frequency * math::cos(angular_frequency * time);
    const Vec3 from_middle = arm(time, place, n);
    return rate * swing + cross((rate * tilt) * tilt_axis, turn_about(tilt_axis, s * tilt, from_middle)) +
           turn_about(tilt_axis, s * tilt, cross(spin * along, from_middle));
  }
  bool oscillates() const { return angular_frequency != 0.0 && (tilt != 0.0 || swing != Vec3{}); }
};

Clamp make_clamp(const ClampConfig& config, const Fiber& fiber) {
  const FiberAxes axes = make_fiber_axes(config.direction, config.roll);
  const double tilt = norm(config.tilt);
  return {config.stiffness,
          config.point,
          config.swing,
          axes.along,
          axes.angle_0,
          axes.angle_90,
          tilt > 0.0 ? config.tilt / tilt : Vec3{1.0, 0.0, 0.0},
          tilt * std::numbers::pi / 180.0,
          config.angular_frequency,
          config.spin,
          fiber.config.radius};
}

/// What a term comes to, summed over the nodes of a section and its clamps: term(clamp, place of the node, its vector).
template <class Term>
KOKKOS_INLINE_FUNCTION double sum_over_nodes(const LoadedSections<Clamp>& loads, const int s,
                                             const ConstVectors& position, const Term& term) {
  const LoadedSection& section = loads.section(s);
  double sum = 0.0;
  for (int i = section.first_load; i < section.end_load; ++i)
    for (int place = 0; place < section.n_nodes; ++place)
      sum += loads.load(i).stiffness / section.n_nodes *
             term(loads.load(i), place, load(position, section.first_node + place));
  return sum;
}

/// Sections held in frames that may swing, tilt and spin.
class Clamps final : public Force {
 public:
  Clamps(const std::vector<ClampConfig>& configs, const std::vector<Fiber>& fibers)
      : loads_(make_loaded_sections<Clamp>("clamp", configs, fibers, make_clamp)),
        time_scale_(find_clamp_time(configs, fibers)),
        of_section_("skein::Clamps::of_section", static_cast<std::size_t>(loads_.n_sections())) {
    for (const ClampConfig& config : configs) {
      const Clamp clamp = make_clamp(config, fibers[config.fiber]);
      if (clamp.oscillates()) fastest_ = std::max(fastest_, std::abs(clamp.angular_frequency));
      fastest_ = std::max(fastest_, std::abs(clamp.spin));
    }
  }

  ForcePromises promises() const override {
    return {.is_conservative = true, .is_steady = fastest_ == 0.0, .reach = 0};
  }

  void add_forces(const double time, const ConstVectors& position, const Vectors& force) const override {
    const LoadedSections<Clamp> loads = loads_;
    launch<ExecSpace>(
        "skein::add_clamp_forces", ExecSpace(), Calls{loads.n_sections(), 50.0}, KOKKOS_LAMBDA(const int s) {
          const LoadedSection& section = loads.section(s);
          for (int i = section.first_load; i < section.end_load; ++i)
            for (int place = 0; place < section.n_nodes; ++place) {
              const int node = section.first_node + place;
              const Vec3 anchor = loads.load(i).anchor(time, place, section.n_nodes);
              store(force, node,
                    load(force, node) + (loads.load(i).stiffness / section.n_nodes) * (anchor - load(position, node)));
            }
        });
  }

  void add_force_changes(double /*time*/, const ConstVectors& /*position*/, const ConstVectors& displacement,
                         const Vectors& change) const override {
    const LoadedSections<Clamp> loads = loads_;
    launch<ExecSpace>(
        "skein::add_clamp_force_changes", ExecSpace(), Calls{loads.n_sections(), 50.0}, KOKKOS_LAMBDA(const int s) {
          const LoadedSection& section = loads.section(s);
          double stiffness = 0.0;
          for (int i = section.first_load; i < section.end_load; ++i) stiffness += loads.load(i).stiffness;
          for (int node = section.first_node; node < section.first_node + section.n_nodes; ++node)
            store(change, node, load(change, node) - (stiffness / section.n_nodes) * load(displacement, node));
        });
  }

  void seek_measures(const double time, const ConstVectors& position) const override {
    const LoadedSections<Clamp> loads = loads_;
    const FoundReals of_section = of_section_;
    launch<ExecSpace>(
        "skein::compute_clamp_energy", ExecSpace(), Calls{loads.n_sections(), 50.0}, KOKKOS_LAMBDA(const int s) {
          const int n = loads.section(s).n_nodes;
          of_section(s) = sum_over_nodes(loads, s, position, [&](const Clamp& clamp, const int place, const Vec3 x) {
            const Vec3 d = clamp.anchor(time, place, n) - x;
            return 0.5 * dot(d, d);
          });
        });
  }
  void add_found_energies(std::vector<double>& energy) const override { add_by_fibers(loads_, of_section_, energy); }

  // The rate of the energy at fixed positions: what the frames do.
  void add_drive_powers(const double time, const ConstVectors& position, const ConstVectors& /*velocity*/,
                        std::vector<double>& power) const override {
    const LoadedSections<Clamp> loads = loads_;
    const FoundReals of_section = of_section_;
    launch<ExecSpace>(
        "skein::compute_clamp_power", ExecSpace(), Calls{loads.n_sections(), 50.0}, KOKKOS_LAMBDA(const int s) {
          const int n = loads.section(s).n_nodes;
          of_section(s) = sum_over_nodes(loads, s, position, [&](const Clamp& clamp, const int place, const Vec3 x) {
            return dot(clamp.anchor(time, place, n) - x, clamp.anchor_velocity(time, place, n));
          });
        });
    wait_for(ExecSpace());
    add_by_fibers(loads, of_section, power);
  }

  double time_scale() const override { return time_scale_; }
  void add_course(TimeCourse& course) const override { add_endless_oscillation(course, fastest_); }

  std::string describe() const override {
    return fmt::format("{} clamp{} in {} frames", loads_.n_loads(), loads_.n_loads() == 1 ? "" : "s",
                       fastest_ == 0.0 ? "fixed" : "moving");
  }

 private:
  LoadedSections<Clamp> loads_;
  double time_scale_;
  FoundReals of_section_;  ///< [n_sections]
  double fastest_ = 0.0;   ///< radians / time
};

}  // namespace

void append_clamps(const SceneConfig& scene, const std::vector<Fiber>& fibers, ForceList& forces) {
  refuse_lines("clamp", "no clamp turns; take a tube, or [[tether]]s that hold two sections", scene.clamps, fibers);
  if (!scene.clamps.empty()) forces.push_back(std::make_unique<Clamps>(scene.clamps, fibers));
}

}  // namespace skein
