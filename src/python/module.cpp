#include <skein/arrays/runtime.hpp>
#include <skein/core/version.hpp>

#include "python/bindings.hpp"
#include "python/device_thread.hpp"

#include <string>

/// The compiled part of the package `skein`, whose modules in Python are what users see.
PYBIND11_MODULE(_native, module) {
  namespace py = pybind11;
  module.attr("version") = std::string(skein::version());
  module.def("describe_build", &skein::describe_build);
  module.def("set_threads", &skein::set_device_threads, py::arg("threads"));
  module.def("finish", &skein::end_device_thread, py::call_guard<py::gil_scoped_release>());
  skein::bind_errors(module);
  skein::bind_scenes(module);
  skein::bind_runs(module);
  skein::bind_studies(module);
  skein::bind_mobility(module);
}
