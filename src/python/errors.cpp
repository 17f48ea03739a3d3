#include <skein/core/error.hpp>
#include <skein/core/resource_error.hpp>

#include "python/bindings.hpp"

#include <fmt/format.h>

#include <exception>
#include <filesystem>
#include <new>
#include <string>

namespace skein {
namespace {

namespace py = pybind11;

/// The class in skein/errors.py that goes with an exit code.
void set_error(const ExitCode code, const std::string& message) {
  const py::object kinds = py::module_::import("skein.errors").attr("OF_CODE");
  PyErr_SetObject(kinds[py::int_(static_cast<int>(code))].ptr(), py::str(message).ptr());
}

/// As the program reports them (cli/cli.cpp).
void translate(const std::exception_ptr error) {
  try {
    std::rethrow_exception(error);
  } catch (const Error& cause) {
    set_error(cause.code(), cause.what());
  } catch (const std::filesystem::filesystem_error& cause) {
    set_error(ExitCode::io_error, fmt::format("'{}': {}", cause.path1().string(), cause.code().message()));
  } catch (const std::bad_alloc&) {
    set_error(ResourceError::exit_code,
              "there is not enough memory; ask for fewer nodes, frames or points, or use a machine "
              "with more");
  }
}

}  // namespace

void bind_errors(py::module_&) {
  py::register_exception_translator([](const std::exception_ptr error) { translate(error); });
}

}  // namespace skein
