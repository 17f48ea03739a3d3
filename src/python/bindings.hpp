#pragma once

#include <pybind11/pybind11.h>

namespace skein {

/// Each adds its part to the module.
void bind_errors(pybind11::module_& module);
void bind_scenes(pybind11::module_& module);
void bind_runs(pybind11::module_& module);
void bind_studies(pybind11::module_& module);
void bind_mobility(pybind11::module_& module);

}  // namespace skein
