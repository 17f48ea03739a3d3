#include <skein/arrays/launch.hpp>

#include "force_table.hpp"
#include "loaded_sections.hpp"
#include "motion_times.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace skein {
namespace {

/// A spring without a rest length between a section's centroid and a point that may move.
struct Tether {
  double stiffness = 0.0;
  Vec3 point, velocity, swing;
  double angular_frequency = 0.0;

  KOKKOS_INLINE_FUNCTION Vec3 anchor(const double time) const {
    return point + time * velocity + math::sin(angular_frequency * time) * swing;
  }
  KOKKOS_INLINE_FUNCTION Vec3 anchor_velocity(const double time) const {
    return velocity + (angular_frequency * math::cos(angular_frequency * time)) * swing;
  }
  bool is_steady() const { return velocity == Vec3{} && (swing == Vec3{} || angular_frequency == 0.0); }
};

/// Springs that hold sections of fibers at points of space. A section's share of the force is equal for all its nodes,
/// so that it is pulled but not deformed.
class Tethers final : public Force {
 public:
  Tethers(const std::vector<TetherConfig>& configs, const std::vector<Fiber>& fibers)
      : loads_(make_loaded_sections<Tether>(
            "tether", configs, fibers,
            [](const TetherConfig& config, const Fiber&) {
              return Tether{config.stiffness, config.point, config.velocity, config.swing, config.angular_frequency};
            })),
        time_scale_(find_tether_time(configs, fibers)),
        of_section_("skein::Tethers::of_section", static_cast<std::size_t>(loads_.n_sections())) {
    for (const TetherConfig& config : configs) {
      const Tether tether{config.stiffness, config.point, config.velocity, config.swing, config.angular_frequency};
      is_steady_ = is_steady_ && tether.is_steady();
      if (tether.swing != Vec3{}) fastest_swing_ = std::max(fastest_swing_, std::abs(tether.angular_frequency));
    }
  }

  ForcePromises promises() const override { return {.is_conservative = true, .is_steady = is_steady_, .reach = 0}; }

  void add_forces(const double time, const ConstVectors& position, const Vectors& force) const override {
    const LoadedSections<Tether> loads = loads_;
    launch<ExecSpace>(
        "skein::add_tether_forces", ExecSpace(), Calls{loads.n_sections(), 50.0}, KOKKOS_LAMBDA(const int s) {
          const LoadedSection& section = loads.section(s);
          const Vec3 centroid = section.mean(position);
          Vec3 sum;
          for (int i = section.first_load; i < section.end_load; ++i)
            sum = sum + loads.load(i).stiffness * (loads.load(i).anchor(time) - centroid);
          add_to_nodes(section, sum, force);
        });
  }

  void add_force_changes(double /*time*/, const ConstVectors& /*position*/, const ConstVectors& displacement,
                         const Vectors& change) const override {
    const LoadedSections<Tether> loads = loads_;
    launch<ExecSpace>(
        "skein::add_tether_force_changes", ExecSpace(), Calls{loads.n_sections(), 50.0}, KOKKOS_LAMBDA(const int s) {
          const LoadedSection& section = loads.section(s);
          double stiffness = 0.0;
          for (int i = section.first_load; i < section.end_load; ++i) stiffness += loads.load(i).stiffness;
          add_to_nodes(section, -stiffness * section.mean(displacement), change);
        });
  }

  void seek_measures(const double time, const ConstVectors& position) const override {
    const LoadedSections<Tether> loads = loads_;
    const FoundReals of_section = of_section_;
    launch<ExecSpace>(
        "skein::compute_tether_energy", ExecSpace(), Calls{loads.n_sections(), 50.0}, KOKKOS_LAMBDA(const int s) {
          const LoadedSection& section = loads.section(s);
          const Vec3 centroid = section.mean(position);
          double sum = 0.0;
          for (int i = section.first_load; i < section.end_load; ++i) {
            const Vec3 d = loads.load(i).anchor(time) - centroid;
            sum += 0.5 * loads.load(i).stiffness * dot(d, d);
          }
          of_section(s) = sum;
        });
  }
  void add_found_energies(std::vector<double>& energy) const override { add_by_fibers(loads_, of_section_, energy); }

  // The rate of the energy at fixed positions: the anchor's pull times its velocity.
  void add_drive_powers(const double time, const ConstVectors& position, const ConstVectors& /*velocity*/,
                        std::vector<double>& power) const override {
    const LoadedSections<Tether> loads = loads_;
    const FoundReals of_section = of_section_;
    launch<ExecSpace>(
        "skein::compute_tether_power", ExecSpace(), Calls{loads.n_sections(), 50.0}, KOKKOS_LAMBDA(const int s) {
          const LoadedSection& section = loads.section(s);
          const Vec3 centroid = section.mean(position);
          double sum = 0.0;
          for (int i = section.first_load; i < section.end_load; ++i) {
            const Tether& tether = loads.load(i);
            sum += tether.stiffness * dot(tether.anchor(time) - centroid, tether.anchor_velocity(time));
          }
          of_section(s) = sum;
        });
    wait_for(ExecSpace());
    add_by_fibers(loads, of_section, power);
  }

  double time_scale() const override { return time_scale_; }
  void add_course(TimeCourse& course) const override { add_endless_oscillation(course, fastest_swing_); }

  std::string describe() const override {
    return fmt::format("{} tether{} to {} points", loads_.n_loads(), loads_.n_loads() == 1 ? "" : "s",
                       is_steady_ ? "fixed" : "moving");
  }

 private:
  LoadedSections<Tether> loads_;
  double time_scale_;
  FoundReals of_section_;  ///< [n_sections]
  bool is_steady_ = true;
  double fastest_swing_ = 0.0;  ///< radians / time
};

}  // namespace

void append_tethers(const SceneConfig& scene, const std::vector<Fiber>& fibers, ForceList& forces) {
  if (!scene.tethers.empty()) forces.push_back(std::make_unique<Tethers>(scene.tethers, fibers));
}

}  // namespace skein
