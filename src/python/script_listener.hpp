#pragma once

#include "runs/run_control.hpp"
#include "runs/run_listener.hpp"

#include <pybind11/pybind11.h>

#include <string>

namespace skein {

/// A script that is told of a run: its messages go to the logger, its frames to a function, which ends the run by
/// returning False or by an exception. The function is called on the thread that runs, with Python's lock.
class ScriptListener final : public RunListener {
 public:
  /// @param on_frame  called with step, time, position, centreline and curvature; None: nobody. Both outlive the
  /// listener
  ScriptListener(RunControl& control, const pybind11::object& on_frame) : control_(control), on_frame_(on_frame) {}

  void say(const std::string& text) override;
  void receive(const Frame& frame) override;

  /// Throws what the function threw, if it did. Without Python's lock, which is taken for it.
  void rethrow();

 private:
  RunControl& control_;
  const pybind11::object& on_frame_;
  PyObject *type_ = nullptr, *value_ = nullptr, *trace_ = nullptr;  ///< of the exception; null: none
};

}  // namespace skein
