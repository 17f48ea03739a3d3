#include "python/messages.hpp"

#include <utility>

namespace skein {
namespace {

namespace py = pybind11;

/// Never destroyed: the interpreter is gone when static objects are.
struct Callees {
  py::object message, warning;
};
Callees& callees() {
  static auto* const both = new Callees;
  return *both;
}

void call(const py::object Callees::*callee, const std::string& text) {
  const py::gil_scoped_acquire locked;
  try {
    (callees().*callee)("%s", text);
  } catch (py::error_already_set& error) {
    error.discard_as_unraisable("skein's messages");
  }
}

}  // namespace

void set_messages(py::object log_message, py::object log_warning) {
  callees() = {std::move(log_message), std::move(log_warning)};
}

void log_message(const std::string& text) { call(&Callees::message, text); }
void log_warning(const std::string& text) { call(&Callees::warning, text); }

}  // namespace skein
