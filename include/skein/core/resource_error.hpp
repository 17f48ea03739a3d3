#pragma once

#include <skein/core/error.hpp>

#include <string>

namespace skein {

/// The system has not the memory, or does not start the threads, that are needed: EX_OSERR of sysexits.h.
class ResourceError : public Error {
 public:
  static constexpr ExitCode exit_code{71};
  explicit ResourceError(const std::string& message) : Error(exit_code, message) {}
};

}  // namespace skein
