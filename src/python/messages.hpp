#pragma once

#include <pybind11/pybind11.h>

#include <string>

namespace skein {

/// Who is called with the texts of log_message and log_warning.
void set_messages(pybind11::object log_message, pybind11::object log_warning);

/// From any thread, without Python's lock, which is taken for it. What a callee throws goes to stderr.
void log_message(const std::string& text);
void log_warning(const std::string& text);

}  // namespace skein
