#include "python/number_arrays.hpp"

namespace skein {

namespace py = pybind11;

py::array_t<double> copy_vectors(const std::vector<Vec3>& vectors) {
  static_assert(sizeof(Vec3) == 3 * sizeof(double));
  const auto n = static_cast<py::ssize_t>(vectors.size());
  return py::array_t<double>({n, py::ssize_t{3}}, vectors.empty() ? nullptr : &vectors.front().x);
}

py::array_t<double> copy_numbers(const std::vector<double>& numbers) {
  return py::array_t<double>(static_cast<py::ssize_t>(numbers.size()), numbers.data());
}

}  // namespace skein
