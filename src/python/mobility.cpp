#include <skein/arrays/types.hpp>
#include <skein/core/error.hpp>
#include <skein/physics/fmm_mobility.hpp>

#include "python/bindings.hpp"
#include "python/device_thread.hpp"
#include "python/messages.hpp"

#include <fmt/format.h>
#include <pybind11/numpy.h>
#include <pybind11/stl.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <tuple>
#include <utility>

namespace skein {
namespace {

namespace py = pybind11;
/// Of doubles in any order of memory; other numbers have been converted.
using Array = py::array_t<double, py::array::forcecast>;

[[noreturn]] void throw_usage(const std::string& message) { throw Error(ExitCode::usage, message); }

std::string describe_shape(const Array& array) {
  std::string text;
  for (py::ssize_t i = 0; i < array.ndim(); ++i) text += fmt::format("{}{}", i == 0 ? "" : ", ", array.shape(i));
  return "[" + text + "]";
}

void check_vectors(const Array& array, const char* name) {
  if (array.ndim() != 2 || array.shape(1) != 3)
    throw_usage(fmt::format("{}: an array [n, 3] is needed, and this one is {}", name, describe_shape(array)));
  const auto values = array.unchecked<2>();
  for (py::ssize_t i = 0; i < array.shape(0); ++i)
    for (py::ssize_t j = 0; j < 3; ++j)
      if (!std::isfinite(values(i, j))) throw_usage(fmt::format("{}[{}, {}] is {}", name, i, j, values(i, j)));
}

void check_numbers(const Array& array, const char* name, const py::ssize_t n) {
  if (array.ndim() != 1 || array.shape(0) != n)
    throw_usage(fmt::format("{}: one number, or one for each of the {} sources, is needed, and this is an array {}",
                            name, n, describe_shape(array)));
  const auto values = array.unchecked<1>();
  for (py::ssize_t i = 0; i < n; ++i)
    if (!(values(i) > 0.0) || !std::isfinite(values(i)))
      throw_usage(fmt::format("{}[{}] is {}: the length over which a force is spread is positive", name, i, values(i)));
}

/// x, y and z are contiguous each and follow each other, as LayoutLeft has them: what numpy calls Fortran's order.
bool lies_as_views_do(const Array& array) {
  constexpr py::ssize_t step = sizeof(double);
  return on_host<ExecSpace> && array.strides(0) == step && array.strides(1) == step * array.shape(0);
}

/// A view of the array's own memory where it lies as views do, else a copy.
ConstVectors view_vectors(const std::string& label, const Array& array) {
  const auto n = static_cast<std::size_t>(array.shape(0));
  if (lies_as_views_do(array)) return ConstVectors(array.data(), n);
  const Vectors device(label, n);
  const auto mirror = Kokkos::create_mirror_view(device);
  const auto values = array.unchecked<2>();
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = 0; j < 3; ++j) mirror(i, j) = values(static_cast<py::ssize_t>(i), static_cast<py::ssize_t>(j));
  Kokkos::deep_copy(device, mirror);
  return device;
}

ConstScalars view_numbers(const std::string& label, const Array& array) {
  const auto n = static_cast<std::size_t>(array.shape(0));
  if (on_host<ExecSpace> && array.strides(0) == sizeof(double)) return ConstScalars(array.data(), n);
  const Scalars device(label, n);
  const auto mirror = Kokkos::create_mirror_view(device);
  const auto values = array.unchecked<1>();
  for (std::size_t i = 0; i < n; ++i) mirror(i) = values(static_cast<py::ssize_t>(i));
  Kokkos::deep_copy(device, mirror);
  return device;
}

/// velocity = the sum, in the memory of an array that lies as views do.
void compute(Mobility& mobility, const Sources& sources, const ConstVectors& target, double* values) {
  const std::size_t n = target.extent(0);
  const Kokkos::View<double* [3], Kokkos::LayoutLeft, Kokkos::HostSpace> host(values, n);
  if constexpr (on_host<ExecSpace>) {
    mobility.add_velocity(sources, target, host);
    Kokkos::fence();
  } else {
    const Vectors velocity("skein::python::velocity", n);
    mobility.add_velocity(sources, target, velocity);
    Kokkos::deep_copy(host, velocity);
  }
}

/// Velocities of points that any forces cause, by a mobility that keeps its operators from call to call.
class PointMobility {
 public:
  /// @param tolerance  0: direct sums in double precision
  PointMobility(const double tolerance, const double viscosity) {
    if (!(viscosity > 0.0) || !std::isfinite(viscosity))
      throw_usage(fmt::format("viscosity = {}: a positive number is needed", viscosity));
    if (!(tolerance >= 0.0 && tolerance < 1.0))
      throw_usage(fmt::format("tolerance = {}: a number from 0 (direct sums) to below 1 is needed", tolerance));
    run_on_device_thread([&] {
      if (tolerance == 0.0) {
        mobility_ = std::make_shared<DirectMobility>(viscosity, Precision::in_double);
        return;
      }
      FmmOptions options;
      options.tolerance = tolerance;
      options.direct_when_cheaper = true;
      options.check_every = 1;
      mobility_ = std::make_shared<FmmMobility>(viscosity, options);
    });
  }
  /// What it holds of the device is given back on the device's thread, which may be busy with a run.
  ~PointMobility() {
    leave_to_device_thread([mobility = std::move(mobility_)]() mutable { mobility.reset(); });
  }
  PointMobility(const PointMobility&) = delete;
  PointMobility& operator=(const PointMobility&) = delete;

  /// @returns velocities [n_targets, 3] in Fortran's order, their error as measured, and how they were found
  std::tuple<Array, double, std::string> find_velocities(const Array& positions, const Array& forces,
                                                         const Array& blobs, const std::optional<Array>& targets) {
    check_vectors(positions, "positions");
    check_vectors(forces, "forces");
    if (forces.shape(0) != positions.shape(0))
      throw_usage(fmt::format("there are {} positions and {} forces; each source has one of both", positions.shape(0),
                              forces.shape(0)));
    check_numbers(blobs, "blobs", positions.shape(0));
    if (targets) check_vectors(*targets, "targets");

    const py::ssize_t n = targets ? targets->shape(0) : positions.shape(0);
    constexpr py::ssize_t step = sizeof(double);
    Array velocity({n, py::ssize_t{3}}, {step, step * n});
    double* const values = velocity.mutable_data();
    std::fill(values, values + 3 * n, 0.0);
    double error = 0.0;
    std::string method;
    {
      const py::gil_scoped_release unlocked;
      run_on_device_thread([&] {
        const Sources sources{view_vectors("skein::python::position", positions),
                              view_vectors("skein::python::force", forces), view_numbers("skein::python::blob", blobs)};
        compute(*mobility_, sources, targets ? view_vectors("skein::python::target", *targets) : sources.position,
                values);
        const ErrorRecord record = mobility_->error_record();
        error = record.order == 0 ? 0.0 : record.last;
        method = record.order == 0 ? "direct sum" : mobility_->describe();
        misses_ = record.n_misses;
        for (const std::string& message : mobility_->take_messages()) log_warning(message);
      });
    }
    return {std::move(velocity), error, std::move(method)};
  }

  /// How many calls found more error than the tolerance: from the first on results depend on it.
  std::int64_t misses() const { return misses_; }

 private:
  std::shared_ptr<Mobility> mobility_;
  std::atomic<std::int64_t> misses_ = 0;
};

}  // namespace

void bind_mobility(py::module_& module) {
  py::class_<PointMobility>(module, "PointMobility")
      .def(py::init<double, double>(), py::arg("tolerance"), py::arg("viscosity"),
           py::call_guard<py::gil_scoped_release>())
      .def("find_velocities", &PointMobility::find_velocities, py::arg("positions"), py::arg("forces"),
           py::arg("blobs"), py::arg("targets"))
      .def_property_readonly("misses", &PointMobility::misses);
}

}  // namespace skein
