#include "runs/scene_summary.hpp"

#include <skein/core/terminal_text.hpp>
#include <skein/fibers/calibration.hpp>
#include <skein/fibers/fiber.hpp>
#include <skein/fibers/node_orbits.hpp>
#include <skein/fibers/spring_network.hpp>
#include <skein/physics/flow_summary.hpp>
#include <skein/physics/repulsion_range.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

namespace skein {
namespace {

constexpr std::size_t max_described = 10;  // fibers

std::string describe_chain(const Fiber& fiber, const BeamStiffness& beam, const int index) {
  const FiberConfig& config = fiber.config;
  return fmt::format(
      "fiber {}: a chain of {} nodes, length {:.6g} (centreline {:.6g}), radius {:g}, spacing {:.6g}\n"
      "  EI {:.6g}, EA {:.6g}, no resistance to twist; couple along a shear {:.4g} a length and {:.4g} at each end, "
      "times its rate\n"
      "  rho = R/L {:.4g}, blob/spacing {:.3g}, blob/radius {:.3g}\n",
      index, config.sections, fiber.length(), fiber.length() - fiber.spacing(), config.radius, fiber.spacing(),
      beam.bending, beam.axial, config.shear_couple, config.end_couple, config.radius / fiber.length(),
      config.blob / fiber.spacing(), config.blob / config.radius);
}

std::string describe_rigid(const Fiber& fiber, const int index) {
  const FiberConfig& config = fiber.config;
  return fmt::format(
      "fiber {}: rigid, a line of {} nodes, length {:.6g} (centreline {:.6g}), radius {:g}, spacing {:.6g}\n"
      "  couple along a shear {:.4g} a length and {:.4g} at each end, times its rate\n"
      "  rho = R/L {:.4g}, blob/spacing {:.3g}, blob/radius {:.3g}\n",
      index, config.sections, fiber.length(), fiber.length() - fiber.spacing(), config.radius, fiber.spacing(),
      config.shear_couple, config.end_couple, config.radius / fiber.length(), config.blob / fiber.spacing(),
      config.blob / config.radius);
}

/// Whether a fiber of this stiffness would stay straight.
/// The threshold is of slender-body theory: Liu, Chakrabarti, Saintillan, Lindner, du Roure, PNAS 115, 9438 (2018).
std::string judge_rigid(const Fiber& fiber, const double viscosity, const double rate, const BeamStiffness& beam) {
  constexpr double first_threshold = 306.4;
  if (std::isinf(beam.relaxed_bending)) return {};  // nobody said what it is
  const double number =
      compute_elasto_viscous_numbers(fiber, viscosity, rate, beam.relaxed_bending).with_minus_log_rho2_e;
  const std::string text = fmt::format(
      "with EI {:.6g} its elasto-viscous number 8 pi mu rate L^4/(c EI), c = -ln(rho^2 "
      "e), would be {:.4g}",
      beam.relaxed_bending, number);
  // A logarithm that is not positive is of a body that is not slender, and does not bend.
  if (!(number > first_threshold))
    return fmt::format("  {}: it stays straight, bends grow above {:g}\n", text, first_threshold);
  return fmt::format(
      "  warning: {}, and above {:g} bends grow while the flow compresses it, which a rigid fiber does not show; model "
      "= "
      "\"chain\" does\n",
      text, first_threshold);
}

std::string describe_tube(const Fiber& fiber, const BeamStiffness& beam, const int index) {
  const FiberConfig& config = fiber.config;
  return fmt::format(
      "fiber {}: {} sections of {} nodes, length {:.6g} (centreline {:.6g}), radius {:g}, spacing {:.6g}, {} springs\n"
      "  with rigid sections, as in the paper: EI {:.6g} (infinite fiber {:.6g}), EA {:.6g}, GJ {:.6g}\n"
      "  at equilibrium, sections free to change shape (infinite fiber): EI {:.6g}, EA {:.6g}\n"
      "  rho = R/L {:.4g}, blob/spacing {:.3g}, blob/radius {:.3g}\n",
      index, config.sections, config.nodes_per_section, fiber.length(), fiber.length() - fiber.spacing(), config.radius,
      fiber.spacing(), count_springs(make_spring_network(fiber)), beam.bending, beam.infinite_bending, beam.axial,
      beam.torsional, beam.relaxed_bending, beam.relaxed_axial, config.radius / fiber.length(),
      config.blob / fiber.spacing(), config.blob / config.radius);
}

/// 8 pi mu rate L^4/(c EI) with both logarithms.
std::string describe_numbers(const Fiber& fiber, const double viscosity, const double rate, const BeamStiffness& beam) {
  const auto relaxed = compute_elasto_viscous_numbers(fiber, viscosity, rate, beam.relaxed_bending);
  if (fiber.config.model == FiberModel::chain)
    return fmt::format(
        "  elasto-viscous number 8 pi mu rate L^4/(c EI): {:.4g} with c = ln(4e/rho^2), {:.4g} with c = -ln(rho^2 e)\n",
        relaxed.with_log_4e_over_rho2, relaxed.with_minus_log_rho2_e);
  const auto rigid = compute_elasto_viscous_numbers(fiber, viscosity, rate, beam.bending);
  return fmt::format(
      "  elasto-viscous number 8 pi mu rate L^4/(c EI): {:.4g} with c = ln(4e/rho^2), {:.4g} with c = "
      "-ln(rho^2 e), by EI of rigid sections;\n"
      "  {:.4g} and {:.4g} by EI at equilibrium, which tells how the fiber bends\n",
      rigid.with_log_4e_over_rho2, rigid.with_minus_log_rho2_e, relaxed.with_log_4e_over_rho2,
      relaxed.with_minus_log_rho2_e);
}

std::string describe_fiber(const SceneConfig& scene, const double rate, const Fiber& fiber, const int index) {
  const FiberConfig& config = fiber.config;
  const BeamStiffness beam = measure_beam_stiffness(fiber);
  if (config.is_rigid())
    return describe_rigid(fiber, index) + (rate > 0.0 ? judge_rigid(fiber, scene.fluid.viscosity, rate, beam) : "");
  std::string text =
      config.model == FiberModel::chain ? describe_chain(fiber, beam, index) : describe_tube(fiber, beam, index);
  const auto [softest, stiffest] =
      std::minmax_element(config.stiffness_profile.begin(), config.stiffness_profile.end(),
                          [](const ProfilePoint& a, const ProfilePoint& b) { return a.factor < b.factor; });
  if (softest->factor != stiffest->factor)
    text += fmt::format(
        "  the stiffness varies along the fiber, from {:g} to {:g} times spring_stiffness: means are given\n",
        softest->factor, stiffest->factor);
  if (rate > 0.0) text += describe_numbers(fiber, scene.fluid.viscosity, rate, beam);
  return text;
}

// The flow presses with a straight piece of fiber; those that it can bend give way. At contact: 32/15 strength
// sqrt(R/range) a length side by side, 4 pi/3 strength R where fibers cross.
std::string describe_repulsion(const SceneConfig& scene, const double rate, const std::vector<Fiber>& fibers) {
  const double strength = scene.repulsion.strength, range = find_repulsion_range(scene.repulsion, fibers);
  if (strength == 0.0) return {};
  double radius = 0.0, length = 0.0;
  for (std::size_t f = 0; f < std::min(fibers.size(), max_described); ++f) {
    radius = std::max(radius, fibers[f].config.radius);
    const double straight =
        fibers[f].config.is_rigid()
            ? fibers[f].length()
            : 4.0 * std::pow(measure_beam_stiffness(fibers[f]).relaxed_bending / (scene.fluid.viscosity * rate), 0.25);
    length = std::max(length, std::min(fibers[f].length(), straight));
  }
  std::string text = fmt::format(
      "repulsion: of strength {:g} where gaps are below {:g}; fibers that touch push with about {:.3g} a length side "
      "by side, with {:.3g} where they cross",
      strength, range, 32.0 / 15.0 * strength * std::sqrt(radius / range),
      4.0 * std::numbers::pi / 3.0 * strength * radius);
  if (rate > 0.0)
    text += fmt::format("; the flow presses crossing ones with about {:.2g}",
                        0.5 * scene.fluid.viscosity * rate * length * length);
  return text + "\n";
}

// What is taken for granted cannot be found.
std::string describe_assumption(const SymmetryConfig& symmetry) {
  if (symmetry.is_none()) return {};
  return fmt::format(
      "symmetry: {}, to the last bit, by assumption: that fibers keep to a plane or stay odd about their middle is "
      "then "
      "no result of a run\n",
      describe_symmetry(symmetry));
}

}  // namespace

std::string describe_scene(const SceneConfig& scene) {
  const auto fibers = make_fibers(scene.fibers);
  const double rate = summarize_flow(scene.flows).typical_rate;
  std::string text;
  if (!scene.title.empty()) text += make_terminal_line(scene.title) + "\n";
  text += fmt::format("{} fiber{}, {} nodes\n", fibers.size(), fibers.size() == 1 ? "" : "s", count_nodes(fibers));
  for (std::size_t f = 0; f < std::min(fibers.size(), max_described); ++f)
    text += describe_fiber(scene, rate, fibers[f], static_cast<int>(f));
  if (fibers.size() > max_described) text += fmt::format("... and {} more\n", fibers.size() - max_described);
  return text + describe_repulsion(scene, rate, fibers) + describe_assumption(scene.symmetry);
}

}  // namespace skein
