#include <skein/core/error.hpp>
#include <skein/scene/scene_file.hpp>

#include "python/bindings.hpp"
#include "runs/child_run.hpp"

#include <fmt/format.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <filesystem>
#include <string>
#include <vector>

namespace skein {
namespace {

namespace py = pybind11;
using Changes = std::vector<std::string>;

NewRun read_text(const std::string& text, const std::string& name, const Changes& changes) {
  NewRun run{read_placed_scene_text(text, name, changes), "", ""};
  if (!run.placed.config.start.checksum.empty())
    throw Error(ExitCode::usage, fmt::format("{}: it begins with the state of another run, which lies beside the "
                                             "scene's file; give the name of that file",
                                             name));
  return run;
}

std::vector<std::string> describe_warnings(const NewRun& scene) {
  std::vector<std::string> texts;
  if (!scene.what_happened.empty()) texts.push_back(scene.what_happened);
  for (const Problem& warning : scene.placed.warnings) texts.push_back(warning.describe());
  return texts;
}

}  // namespace

void bind_scenes(py::module_& module) {
  py::class_<NewRun>(module, "Scene")
      .def_property_readonly("text", [](const NewRun& scene) { return scene.placed.text; })
      .def_property_readonly("warnings", &describe_warnings);
  using Unlocked = py::call_guard<py::gil_scoped_release>;
  module.def("read_scene_file", &make_new_run, py::arg("file"), py::arg("changes"), Unlocked());
  module.def("read_scene_text", &read_text, py::arg("text"), py::arg("name"), py::arg("changes"), Unlocked());
  module.def("continue_run", &make_child_run, py::arg("parent"), py::arg("file"), py::arg("changes"), Unlocked());
}

}  // namespace skein
