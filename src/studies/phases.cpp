#include "studies/phases.hpp"

#include <skein/analysis/regime.hpp>
#include <skein/core/error.hpp>
#include <skein/fibers/start_check.hpp>
#include <skein/io/array_file.hpp>
#include <skein/scene/scene_file.hpp>

#include "runs/memory_limit.hpp"
#include "studies/rung.hpp"
#include "studies/rung_name.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>
#include <system_error>

namespace skein {
namespace {

/// Columns of phases.csv; "perturbed" comes after the second.
constexpr const char* columns[] = {
    "length", "elasto_viscous_number", "regime",        "half_period",     "curvature_max",
    "wave",   "hook_radius",           "snaking_speed", "symmetry_defect", "out_of_plane"};

std::size_t find_quantity(const std::string& name) {
  const auto& quantities = list_fiber_quantities();
  const auto found = std::find_if(quantities.begin(), quantities.end(),
                                  [&](const MeasuredQuantity& quantity) { return quantity.name == name; });
  SKEIN_REQUIRE(found != quantities.end(), fmt::format("'{}' is measured", name));
  return static_cast<std::size_t>(found - quantities.begin());
}

SceneConfig perturb(const SceneConfig& scene, const std::vector<std::string>& overrides) {
  return read_scene_text(write_scene(scene), "the perturbed scene", overrides, find_start_problems).config;
}

RunList list_runs(const PhaseStudy& study, const std::vector<PhasePoint>& points) {
  RunList list;
  list.runs = study.folder;
  list.results = study.folder / "results";
  for (const PhasePoint& point : points) {
    list.names.push_back(point.folder);
    add_estimates(list, point.scene);
  }
  list.make = [points](const std::size_t i) { return NewRun{{points[i].scene, {}, ""}, "", ""}; };
  return list;
}

void write_results(const std::filesystem::path& path, const std::vector<PhasePoint>& points,
                   const std::vector<std::optional<RunResult>>& results) {
  std::vector<NamedArray> table;
  const auto add = [&](const std::string& name, const char* unit, const auto& value_of) {
    NamedArray& column = table.emplace_back(NamedArray{name, unit, {}, {}});
    for (std::size_t i = 0; i < points.size(); ++i)
      if (results[i] && results[i]->code == ExitCode::done) column.values.push_back(value_of(i));
  };
  for (const char* name : columns) {
    if (table.size() == 2)
      add("perturbed", "", [&](const std::size_t i) { return points[i].is_perturbed ? 1.0 : 0.0; });
    const std::size_t quantity = find_quantity(name);
    add(name, list_fiber_quantities()[quantity].unit,
        [&](const std::size_t i) { return results[i]->measures.over_fibers(quantity); });
  }
  if (!table[0].values.empty()) write_csv(path, table);  // the one that is there is not replaced by nothing
}

}  // namespace

std::string describe_phase(const PhasePoint& point, const RunMeasures& measures) {
  const auto value = [&](const char* name) { return measures.over_fibers(find_quantity(name)); };
  return fmt::format("{:<10.4g} {:<10.4g} {:<10} {}", value("length"), value("elasto_viscous_number"),
                     point.is_perturbed ? "perturbed" : "straight",
                     name_of(static_cast<Regime>(static_cast<int>(value("regime")))));
}

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

ExitCode run_phase_study(const PhaseStudy& study, const std::vector<PhasePoint>& points, SideBySideListener& listener) {
  const RunList list = list_runs(study, points);
  std::error_code error;
  std::filesystem::create_directories(list.results, error);
  if (error)
    throw Error(ExitCode::cannot_create,
                fmt::format("cannot create '{}': {}.", list.results.string(), error.message()));
  std::vector<std::size_t> all(points.size());
  std::iota(all.begin(), all.end(), std::size_t{0});
  // Each is looked at again, whether it is done or not: its folder may hold a run of another scene.
  const auto results = run_side_by_side(list, all, study.how, listener);
  write_results(study.folder / "phases.csv", points, results);
  ExitCode worst = ExitCode::done;
  for (const auto& result : results) {
    if (!result) return ExitCode::stopped;
    if (worst == ExitCode::done) worst = result->code;
  }
  return worst;
}

}  // namespace skein
