#include <skein/core/error.hpp>

namespace skein {

void throw_broken_precondition(const char* condition, const std::string& message, const char* file, const int line) {
  throw Error(ExitCode::internal,
              std::string(file) + ":" + std::to_string(line) + ": " + message + " (" + condition + ")");
}

}  // namespace skein
