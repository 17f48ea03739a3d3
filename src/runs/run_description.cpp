#include "runs/run_description.hpp"

#include <skein/arrays/runtime.hpp>
#include <skein/core/duration.hpp>
#include <skein/core/error.hpp>
#include <skein/core/version.hpp>
#include <skein/fibers/calibration.hpp>
#include <skein/physics/flow_summary.hpp>
#include <skein/physics/mobility_choice.hpp>
#include <skein/physics/scene_times.hpp>
#include <skein/scene/words.hpp>

#include "runs/expected_output.hpp"
#include "runs/scene_summary.hpp"
#include "runs/useful_threads.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace skein {
namespace {

/// "to t = 12", with the start where that is not 0
std::string describe_span(const SceneConfig& scene) {
  std::string text = fmt::format("to t = {:g}", scene.time.end);
  if (scene.time.start > 0.0) text = fmt::format("from t = {:g} {}", scene.time.start, text);
  if (!scene.start.parent.empty()) text += fmt::format(", begun with the state of '{}'", scene.start.parent);
  return text;
}

}  // namespace

TrajectoryLayout describe_layout(const SceneConfig& scene, const std::string& scene_text,
                                 const std::vector<Fiber>& fibers) {
  const FlowSummary flow = summarize_flow(scene.flows);
  TrajectoryLayout layout;
  layout.fibers = fibers;
  layout.blobs = make_blobs(fibers);
  layout.attributes = {{"title", scene.title},      {"scene", scene_text},
                       {"version", version()},      {"commit", commit()},
                       {"build", describe_build()}, {"backend", describe_backend()},
                       {"flow", flow.description},  {"integrator", word_of(scene.time.method)}};
  const double rate = flow.typical_rate;
  std::vector<double> length, rigidity, relaxed_rigidity, number, number_slender, relaxed_number,
      relaxed_number_slender;
  for (const Fiber& fiber : fibers) {
    const BeamStiffness beam = measure_beam_stiffness(fiber);
    length.push_back(fiber.length());
    rigidity.push_back(beam.bending);
    relaxed_rigidity.push_back(beam.relaxed_bending);
    const auto numbers = compute_elasto_viscous_numbers(fiber, scene.fluid.viscosity, rate, beam.bending);
    number.push_back(numbers.with_log_4e_over_rho2);
    number_slender.push_back(numbers.with_minus_log_rho2_e);
    const auto relaxed = compute_elasto_viscous_numbers(fiber, scene.fluid.viscosity, rate, beam.relaxed_bending);
    relaxed_number.push_back(relaxed.with_log_4e_over_rho2);
    relaxed_number_slender.push_back(relaxed.with_minus_log_rho2_e);
  }
  layout.parameters = {{"fiber_length", {length, "length"}},
                       {"bending_rigidity", {rigidity, "force*length^2"}},
                       {"relaxed_bending_rigidity", {relaxed_rigidity, "force*length^2"}},
                       {"viscosity", {scene.fluid.viscosity, "force*time/length^2"}},
                       {"shear_rate", {rate, "1/time"}},
                       {"elasto_viscous_number_log_4e_over_rho2", {number, "1"}},
                       {"elasto_viscous_number_minus_log_rho2_e", {number_slender, "1"}},
                       {"relaxed_elasto_viscous_number_log_4e_over_rho2", {relaxed_number, "1"}},
                       {"relaxed_elasto_viscous_number_minus_log_rho2_e", {relaxed_number_slender, "1"}}};
  return layout;
}

std::string describe_run(const SceneConfig& scene, const std::vector<Fiber>& fibers, const std::string& forces,
                         const std::string& integrator, const Prospect& prospect) {
  const auto& [cost, spectral_radius, step, checkpoint_bytes] = prospect;
  const double n_steps = (scene.time.end - scene.time.start) / step.dt;
  std::string text = fmt::format("skein {} ({}) on {}\n", version(), commit(), describe_backend());
  text += describe_threads(scene) + '\n' + describe_scene(scene);
  if (!forces.empty()) text += fmt::format("forces: {}\n", forces);
  text += fmt::format("flow: {}\nmobility: {}\ntime: {}, {}\n", summarize_flow(scene.flows).description,
                      describe_choice(choose_mobility(scene), scene), integrator, describe_span(scene));
  if (cost.direct_seconds > 0.0)
    text += fmt::format("a direct sum would take about {:.3g} ms, {:.1f} times as long\n", 1e3 * cost.direct_seconds,
                        cost.direct_seconds / cost.seconds);
  const Expectation expectation{n_steps, n_steps * step.work * cost.seconds, checkpoint_bytes};
  text += fmt::format(
      "cost: {:.3g} ms an evaluation, wall time beside what else this machine does now; roughly {:.2g} evaluations, "
      "{}; {}",
      1e3 * cost.seconds, n_steps * step.evaluations, format_duration(expectation.seconds),
      describe_expected_output(scene, fibers, expectation));
  const double product = scene.time.step * spectral_radius;
  if (scene.time.method == TimeMethod::euler && product > 2.0)
    text += fmt::format(
        "\nwarning: the step times the spectral radius at the start ({:.4g}) is {:.3g}; forward Euler is unstable "
        "above 2: set time.step below {:.3g}, or use time.method = \"rkc2\"",
        spectral_radius, product, 2.0 / spectral_radius);
  return text;
}

}  // namespace skein
