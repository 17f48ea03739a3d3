#include <skein/scene/scene_file.hpp>

#include "python/bindings.hpp"
#include "python/device_thread.hpp"
#include "python/messages.hpp"
#include "runs/child_run.hpp"
#include "runs/run_analysis.hpp"
#include "studies/plan.hpp"

#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <filesystem>
#include <optional>
#include <string>
#include <utility>

namespace skein {
namespace {

namespace py = pybind11;

/// @returns the summary as JSON
std::string analyze(const std::filesystem::path& path, const std::filesystem::path& tables, const bool with_forces) {
  const RunFolder folder = RunFolder::open(path);
  if (!tables.empty()) check_output(tables, folder);
  std::string summary;
  run_on_device_thread([&] {
    const RunAnalysis analysis = analyze_run(folder, with_forces);
    write_analysis(analysis, tables.empty() ? folder.analysis() : tables);
    summary = describe_analysis_as_json(analysis);
  });
  return summary;
}

struct PlannedScene {
  std::optional<NewRun> scene;  ///< none: no model is good enough
  std::string reason, table;
};

PlannedScene plan(const NewRun& run, const double tolerance, const double max_seconds) {
  PlanRequest request;
  request.tolerance = tolerance;
  request.max_seconds = max_seconds;
  Plan plan;
  run_on_device_thread([&] { plan = make_plan(run.placed.config, request, log_message); });
  PlannedScene planned{std::nullopt, plan.reason, describe_plan(plan, request)};
  if (plan.chosen >= 0) {
    SceneConfig& chosen = plan.candidates[static_cast<std::size_t>(plan.chosen)].scene;
    std::string text = write_readable_scene(chosen);
    planned.scene = NewRun{{std::move(chosen), {}, std::move(text)}, "", ""};
  }
  return planned;
}

}  // namespace

void bind_studies(py::module_& module) {
  using Unlocked = py::call_guard<py::gil_scoped_release>;
  module.def("analyze", &analyze, py::arg("folder"), py::arg("tables"), py::arg("with_forces"), Unlocked());
  py::class_<PlannedScene>(module, "PlannedScene")
      .def_readonly("scene", &PlannedScene::scene)
      .def_readonly("reason", &PlannedScene::reason)
      .def_readonly("table", &PlannedScene::table);
  module.def("plan", &plan, py::arg("scene"), py::arg("tolerance"), py::arg("max_seconds"), Unlocked());
}

}  // namespace skein
