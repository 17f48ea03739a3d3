#pragma once

#include <skein/core/vec3.hpp>

#include <pybind11/numpy.h>

#include <vector>

namespace skein {

/// Arrays of numpy with a copy of what a list holds: [n, 3] in C's order, and [n].
pybind11::array_t<double> copy_vectors(const std::vector<Vec3>& vectors);
pybind11::array_t<double> copy_numbers(const std::vector<double>& numbers);

}  // namespace skein
