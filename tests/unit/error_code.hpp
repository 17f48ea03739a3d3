#pragma once

#include <skein/core/error.hpp>

#include <functional>
#include <string>

namespace skein {

/// The code of the Error that a call throws, `done` if it throws none; its message too where one is asked for.
inline ExitCode code_of(const std::function<void()>& call, std::string* message = nullptr) {
  try {
    call();
  } catch (const Error& error) {
    if (message != nullptr) *message = error.what();
    return error.code();
  }
  return ExitCode::done;
}

}  // namespace skein
