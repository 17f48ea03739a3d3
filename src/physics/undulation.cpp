#include "force_table.hpp"
#include "motion_times.hpp"
#include "node_sums.hpp"
#include "wave_springs.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace skein {
namespace {

struct SetCurvature {
  WaveArrays waves;
  double time;

  KOKKOS_INLINE_FUNCTION void operator()(const int gap) const {
    waves.curvature(gap) = sum_waves(waves, waves.gap(gap), time);
  }
};

/// What a wave adds to the force of a spring is linear in the vector d between its ends: -k (1/l(t) - 1/l) d.
struct AddWaveForce {
  WaveArrays waves;
  ConstVectors position;
  Vectors force;

  KOKKOS_INLINE_FUNCTION void operator()(const int node) const {
    if (waves.fiber_of_node(node) < 0) return;
    const Vec3 x = load(position, node);
    Vec3 sum;
    for_springs_of(waves, node, true, [&](const int other, const RestChange& spring) {
      sum = sum - spring.stiffness * spring.inverse_change * (x - load(position, other));
    });
    store(force, node, load(force, node) + sum);
  }
};

/// Half of the stiffness times a term, summed over a node's springs to later sections: term(r^2, rest change).
template <class Term>
KOKKOS_INLINE_FUNCTION double sum_later_springs(const WaveArrays& waves, const ConstVectors& position, const int node,
                                                const Term& term) {
  if (waves.fiber_of_node(node) < 0) return 0.0;
  const Vec3 x = load(position, node);
  double sum = 0.0;
  for_springs_of(waves, node, false, [&](const int other, const RestChange& spring) {
    if (spring.stiffness == 0.0) return;
    const Vec3 d = x - load(position, other);
    sum += 0.5 * spring.stiffness * term(dot(d, d), spring);
  });
  return sum;
}

/// The energy k l(t) (r/l(t) - 1)^2 / 2 of springs, less what it is without waves.
struct WaveEnergy {
  WaveArrays waves;
  ConstVectors position;

  KOKKOS_INLINE_FUNCTION double operator()(const int node) const {
    return sum_later_springs(waves, position, node, [](const double square, const RestChange& spring) {
      return square * spring.inverse_change + spring.change;
    });
  }
};

/// Its rate of change where nodes stand still.
struct WavePower {
  WaveArrays waves;
  ConstVectors position;

  KOKKOS_INLINE_FUNCTION double operator()(const int node) const {
    return sum_later_springs(waves, position, node, [](const double square, const RestChange& spring) {
      return spring.rate * (1.0 - square / (spring.length * spring.length));
    });
  }
};

int find_reach(const std::vector<Fiber>& fibers) {
  int reach = 0;
  for (const Fiber& fiber : fibers) reach = std::max(reach, fiber.config.reach_along);
  return reach;
}

std::ptrdiff_t count_helices(const std::vector<Fiber>& fibers) {
  return std::count_if(fibers.begin(), fibers.end(), [](const Fiber& fiber) { return fiber.config.is_helix(); });
}

/// Waves of preferred curvature, and rest shapes that are helices, as changes of the lengths at rest of the springs
/// between sections: what they add to the forces of these springs.
class Undulations final : public Force {
 public:
  Undulations(const std::vector<UndulationConfig>& configs, const std::vector<Fiber>& fibers)
      : configs_(configs),
        waves_(make_wave_arrays(configs, fibers)),
        sums_("skein::Undulations::sums", fibers, waves_.fiber_of_node.extent(0)),
        n_helices_(count_helices(fibers)),
        reach_(find_reach(fibers)) {}

  ForcePromises promises() const override {
    bool is_steady = true;
    for (const UndulationConfig& config : configs_)
      is_steady = is_steady && config.angular_frequency == 0.0 && config.ramp == 0.0;
    return {.is_balanced = true,
            .is_torque_free = true,
            .is_conservative = true,
            .is_steady = is_steady,
            .is_frame_indifferent = true,
            .reach = reach_};
  }

  void add_forces(const double time, const ConstVectors& position, const Vectors& force) const override {
    add_forces_on(0, position.extent_int(0), time, {position, {}, {}, {}}, force);
  }
  void add_force_changes(const double time, const ConstVectors& position, const ConstVectors& displacement,
                         const Vectors& change) const override {
    add_force_changes_on(0, position.extent_int(0), time, {position, {}, displacement, {}}, change);
  }

  void add_forces_on(const int first, const int n, const double time, const SeenNodes& nodes,
                     const Vectors& force) const override {
    set_time(time);
    Kokkos::parallel_for("skein::add_undulation_forces", Nodes(ExecSpace(), first, first + n),
                         AddWaveForce{waves_, nodes.position, force});
  }
  void add_force_changes_on(const int first, const int n, const double time, const SeenNodes& nodes,
                            const Vectors& change) const override {
    set_time(time);
    Kokkos::parallel_for("skein::add_undulation_force_changes", Nodes(ExecSpace(), first, first + n),
                         AddWaveForce{waves_, nodes.displacement, change});
  }

  void seek_measures(const double time, const ConstVectors& position) const override {
    set_time(time);
    sums_.seek("skein::compute_undulation_energy", WaveEnergy{waves_, position});
  }
  void add_found_energies(std::vector<double>& energy) const override { sums_.add_found(energy); }

  void add_drive_powers(const double time, const ConstVectors& position, const ConstVectors& /*velocity*/,
                        std::vector<double>& power) const override {
    set_time(time);
    sums_.add("skein::compute_undulation_power", power, WavePower{waves_, position});
  }

  double time_scale() const override { return find_undulation_time(configs_); }

  void add_course(TimeCourse& course) const override {
    for (const UndulationConfig& config : configs_) {
      add_endless_oscillation(course, config.angular_frequency);
      if (config.ramp > 0.0) course.add_ramp(0.0, config.ramp);
    }
  }

  std::string describe() const override {
    const std::string waves =
        fmt::format("{} wave{} of preferred curvature", configs_.size(), configs_.size() == 1 ? "" : "s");
    if (n_helices_ == 0) return waves;
    const std::string helices = fmt::format("{} helix{} at rest", n_helices_, n_helices_ == 1 ? "" : "es");
    return configs_.empty() ? helices : helices + ", " + waves;
  }

 private:
  using Nodes = Kokkos::RangePolicy<ExecSpace>;

  void set_time(const double time) const {
    Kokkos::parallel_for("skein::compute_preferred_curvature",
                         Kokkos::RangePolicy<ExecSpace>(ExecSpace(), 0, waves_.gap.extent(0)),
                         SetCurvature{waves_, time});
  }

  std::vector<UndulationConfig> configs_;
  WaveArrays waves_;
  NodeSums sums_;
  std::ptrdiff_t n_helices_;
  int reach_;
};

}  // namespace

void append_undulations(const SceneConfig& scene, const std::vector<Fiber>& fibers, ForceList& forces) {
  if (!scene.undulations.empty() || count_helices(fibers) > 0)
    forces.push_back(std::make_unique<Undulations>(scene.undulations, fibers));
}

}  // namespace skein
