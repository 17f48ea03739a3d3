#pragma once

#include <skein/arrays/types.hpp>
#include <skein/core/smooth_step.hpp>
#include <skein/fibers/fiber.hpp>
#include <skein/scene/scene_config.hpp>

#include <vector>

namespace skein {

/// A wave of preferred curvature along a fiber, of UndulationConfig.
struct Wave {
  double curvature_towards_first, curvature_across;  ///< 1 / length: towards a section's node 0, and 90 degrees on
  double wave_number, angular_frequency, phase, ramp;
  int first_envelope;  ///< of its factors at the fiber's sections
};

/// A curvature and its rate of change, by its parts towards a section's node 0 and 90 degrees on. 1 / length (/ time)
struct Curvature {
  double first = 0.0, across = 0.0, first_rate = 0.0, across_rate = 0.0;
};

/// A fiber with waves, or a rest shape that is not straight, and the springs between its sections.
struct WavingFiber {
  int first_node, n_sections, nodes_per_section, reach;
  int first_entry;    ///< of its stencil
  int first_section;  ///< of its factors of stiffness
  int first_gap;      ///< of its gaps: [n_sections, reach]
  int first_wave, end_wave;
  int first_place;  ///< of its nodes' places on a section
  double spacing;
};

/// Sections of a fiber between which springs lie.
struct Gap {
  int fiber, section, offset;
  double rest_first, rest_across;  ///< curvature of the fiber's rest shape
};

struct WaveArrays {
  Kokkos::View<WavingFiber*, ExecSpace> fiber;
  Kokkos::View<int*, ExecSpace> fiber_of_node;  ///< [n_nodes]; -1: none
  Kokkos::View<Gap*, ExecSpace> gap;
  Kokkos::View<Wave*, ExecSpace> wave;
  Kokkos::View<Curvature*, ExecSpace> curvature;  ///< [n_gaps], halfway between the sections, at the last time
  ConstVectors place;  ///< [nodes on a section, 3]: towards node 0 and 90 degrees on from the middle, length; 0
  ConstScalars envelope, section_factor;
  ConstScalars stiffness, rest_length;  ///< [n_entries], force and length
};

/// @param undulations  of the scene  @param fibers  of all waves, and others
WaveArrays make_wave_arrays(const std::vector<UndulationConfig>& undulations, const std::vector<Fiber>& fibers);

/// What a spring between sections has become: the inverse of its length at rest less what it is without waves, that
/// length and its rate of change.
struct RestChange {
  double stiffness, inverse_change, length, change, rate;
};

/// At the middle of a gap.
KOKKOS_INLINE_FUNCTION Curvature sum_waves(const WaveArrays& waves, const Gap& gap, const double time) {
  const WavingFiber& fiber = waves.fiber(gap.fiber);
  const double place = (gap.section + 0.5 * gap.offset) * fiber.spacing;
  Curvature sum{gap.rest_first, gap.rest_across};
  for (int w = fiber.first_wave; w < fiber.end_wave; ++w) {
    const Wave& wave = waves.wave(w);
    const double angle = wave.wave_number * place - wave.angular_frequency * time + wave.phase;
    const double share = wave.ramp > 0.0 ? time / wave.ramp : 1.0;
    const double envelope = 0.5 * (waves.envelope(wave.first_envelope + gap.section) +
                                   waves.envelope(wave.first_envelope + gap.section + gap.offset));
    const double value = envelope * smooth_step(share) * math::cos(angle);
    const double ramp_rate = wave.ramp > 0.0 ? smooth_step_slope(share) / wave.ramp : 0.0;
    const double rate =
        envelope * (smooth_step(share) * wave.angular_frequency * math::sin(angle) + ramp_rate * math::cos(angle));
    sum.first += wave.curvature_towards_first * value;
    sum.across += wave.curvature_across * value;
    sum.first_rate += wave.curvature_towards_first * rate;
    sum.across_rate += wave.curvature_across * rate;
  }
  return sum;
}

/// Of the spring from node a of a section to node b of one `offset` further on. In a bend, sections turn towards each
/// other where nodes are nearer to its centre: along the fiber their distance is (1 - curvature x) of what it was.
KOKKOS_INLINE_FUNCTION RestChange find_rest_change(const WaveArrays& waves, const WavingFiber& fiber, const int section,
                                                   const int offset, const int a, const int b) {
  const int n = fiber.nodes_per_section;
  const int entry = fiber.first_entry + offset * n + (b - a + n) % n;
  const double stiffness = waves.stiffness(entry);
  if (stiffness == 0.0) return {};
  const Curvature& curvature = waves.curvature(fiber.first_gap + section * fiber.reach + offset - 1);
  const Vec3 one = load(waves.place, fiber.first_place + a), other = load(waves.place, fiber.first_place + b);
  const double first = 0.5 * (one.x + other.x), across = 0.5 * (one.y + other.y);
  const double stretch = 1.0 - curvature.first * first - curvature.across * across;
  const double stretch_rate = -curvature.first_rate * first - curvature.across_rate * across;
  const double along = offset * fiber.spacing, rest = waves.rest_length(entry);
  const double length = math::sqrt(rest * rest + along * along * (stretch * stretch - 1.0));
  const double factor = 0.5 * (waves.section_factor(fiber.first_section + section) +
                               waves.section_factor(fiber.first_section + section + offset));
  // The difference of the inverses, without cancellation.
  const double inverse_change = along * along * (1.0 - stretch * stretch) / (length * rest * (length + rest));
  return {factor * stiffness, inverse_change, length, length - rest, along * along * stretch * stretch_rate / length};
}

/// Visits the springs of a node to later sections, and to earlier ones where `both`: visit(other node, rest change).
template <class Visit>
KOKKOS_INLINE_FUNCTION void for_springs_of(const WaveArrays& waves, const int node, const bool both,
                                           const Visit& visit) {
  const WavingFiber& fiber = waves.fiber(waves.fiber_of_node(node));
  const int n = fiber.nodes_per_section;
  const int section = (node - fiber.first_node) / n, place = (node - fiber.first_node) % n;
  for (int offset = 1; offset <= fiber.reach; ++offset)
    for (int other = 0; other < n; ++other) {
      if (section + offset < fiber.n_sections)
        visit(node + offset * n - place + other, find_rest_change(waves, fiber, section, offset, place, other));
      if (both && section >= offset)
        visit(node - offset * n - place + other,
              find_rest_change(waves, fiber, section - offset, offset, other, place));
    }
}

}  // namespace skein
