#include "python/script_listener.hpp"

#include "python/messages.hpp"
#include "python/number_arrays.hpp"

namespace skein {

namespace py = pybind11;

void ScriptListener::say(const std::string& text) { log_message(text); }

void ScriptListener::receive(const Frame& frame) {
  const py::gil_scoped_acquire locked;
  if (on_frame_.is_none() || type_ != nullptr) return;
  try {
    const py::object answer = on_frame_(frame.step, frame.time, copy_vectors(frame.position),
                                        copy_vectors(frame.centreline), copy_numbers(frame.curvature));
    const int is_true = answer.is_none() ? 1 : PyObject_IsTrue(answer.ptr());  // numpy has a False of its own
    if (is_true < 0) throw py::error_already_set();
    if (is_true == 0) control_.ask_to_stop("on_frame returned False");
  } catch (py::error_already_set& error) {
    error.restore();
    PyErr_Fetch(&type_, &value_, &trace_);
    control_.ask_to_stop("on_frame raised an exception");
  }
}

void ScriptListener::rethrow() {
  if (type_ == nullptr) return;
  const py::gil_scoped_acquire locked;
  PyErr_Restore(type_, value_, trace_);
  type_ = value_ = trace_ = nullptr;
  throw py::error_already_set();
}

}  // namespace skein
