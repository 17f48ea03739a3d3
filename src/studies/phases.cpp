#include "studies/phases.hpp"

#include <skein/fibers/calibration.hpp>
#include <skein/fibers/start_check.hpp>
#include <skein/io/array_file.hpp>
#include <skein/scene/scene_file.hpp>

#include "runs/run_to_end.hpp"
#include "studies/rung.hpp"
#include "studies/rung_name.hpp"

#include <fmt/format.h>

namespace skein {
namespace {

constexpr double shear_rate = 2.5;  // of the paper

SceneConfig perturb(const SceneConfig& scene, const std::vector<std::string>& overrides) {
  return read_scene_text(write_scene(scene), "the perturbed scene", overrides, find_start_problems).config;
}

PhaseResult measure_point(const PhasePoint& point, const RunAnalysis& analysis) {
  const Fiber& fiber = analysis.fibers[0];
  const double bending = measure_beam_stiffness(fiber).bending;
  const double viscosity = point.scene.fluid.viscosity;
  return {fiber.length(), compute_elasto_viscous_numbers(fiber, viscosity, shear_rate, bending).with_log_4e_over_rho2,
          point.is_perturbed, analysis.histories[0].summarize()};
}

void write_results(const std::filesystem::path& path, const std::vector<PhaseResult>& results) {
  constexpr double none = std::numeric_limits<double>::quiet_NaN();
  std::vector<NamedArray> columns;
  const auto add = [&](const char* name, const char* unit, const auto& value_of) {
    NamedArray& column = columns.emplace_back(NamedArray{name, unit, {}, {}});
    for (const PhaseResult& result : results) column.values.push_back(static_cast<double>(value_of(result)));
  };
  add("length", "length", [](const PhaseResult& r) { return r.length; });
  add("elasto_viscous_number", "", [](const PhaseResult& r) { return r.elasto_viscous_number; });
  add("perturbed", "", [](const PhaseResult& r) { return r.is_perturbed; });
  add("regime", "", [](const PhaseResult& r) { return r.summary.regime; });
  add("half_period", "time",
      [](const PhaseResult& r) { return r.summary.half_periods.empty() ? none : r.summary.half_periods[0]; });
  add("curvature_max", "1/length", [](const PhaseResult& r) { return r.summary.curvature_max; });
  add("wave", "", [](const PhaseResult& r) { return r.summary.wave; });
  add("hook_radius", "length",
      [](const PhaseResult& r) { return r.summary.snaking ? r.summary.snaking->hook_radius : none; });
  add("snaking_speed", "length/time",
      [](const PhaseResult& r) { return r.summary.snaking ? r.summary.snaking->speed : none; });
  add("symmetry_defect", "", [](const PhaseResult& r) { return r.summary.symmetry_defect_max; });
  add("out_of_plane", "length", [](const PhaseResult& r) { return r.summary.out_of_plane_max; });
  write_csv(path, columns);
}

}  // namespace

std::vector<PhasePoint> list_phase_points(const PhaseStudy& study) {
  std::vector<PhasePoint> points;
  for (const bool is_perturbed : {false, true}) {
    if (is_perturbed && study.perturbation.empty()) continue;
    for (int i = 0; i < study.count; ++i) {
      const double length =
          study.count == 1 ? study.from : study.from + (study.to - study.from) * i / (study.count - 1);
      const int sections = count_paper_sections(length);
      SceneConfig scene = make_rung_scene(make_paper_scene(sections, study.end), study.rung);
      if (is_perturbed) scene = perturb(scene, study.perturbation);
      points.push_back(
          {fmt::format("{}_{:04}_{}", is_perturbed ? "perturbed" : "straight", sections, name_of_rung(study.rung)),
           is_perturbed, scene});
    }
  }
  return points;
}

ExitCode run_phase_study(const PhaseStudy& study, const std::vector<PhasePoint>& points, RunListener& listener,
                         const std::function<void(const PhaseResult&)>& report) {
  std::vector<PhaseResult> results;
  for (const PhasePoint& point : points) {
    const std::filesystem::path path = study.folder / point.folder;
    if (run_to_end(point.scene, path, study.max_walltime, listener) == ExitCode::stopped) return ExitCode::stopped;
    results.push_back(measure_point(point, analyze_run(RunFolder::open(path), /*with_forces=*/false)));
    report(results.back());
    write_results(study.folder / "phases.csv", results);
  }
  return ExitCode::done;
}

}  // namespace skein
