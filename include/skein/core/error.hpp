#pragma once

#include <stdexcept>
#include <string>

namespace skein {

/// How the program ends. The numbers are those of sysexits.h, so that scripts can tell causes apart.
enum class ExitCode : int {
  done = 0,
  usage = 64,          ///< the command line is wrong
  damaged_data = 65,   ///< a file of a run is damaged and nothing older can serve
  missing_input = 66,  ///< a file that was named is not there
  internal = 70,       ///< a bug of this program
  cannot_create = 73,  ///< an output cannot be created, or would overwrite something
  io_error = 74,       ///< a write failed: disk full, I/O error
  stopped = 75,        ///< stopped on request or by walltime; can be resumed
  numerical = 76,      ///< blow-up, NaN, no convergence
  scene_error = 78,    ///< the scene file is wrong
};

/// Every error that a user can cause or meet. The message says what is wrong, where, and what to do.
class Error : public std::runtime_error {
 public:
  Error(ExitCode code, const std::string& message) : std::runtime_error(message), code_(code) {}
  ExitCode code() const { return code_; }

 private:
  ExitCode code_;
};

[[noreturn]] void throw_broken_precondition(const char* condition, const std::string& message, const char* file,
                                            int line);

}  // namespace skein

/// A precondition of a function: throws Error(internal, "file:line: message (condition)").
/// The message is evaluated only on failure.
#define SKEIN_REQUIRE(condition, message)                                                            \
  do {                                                                                               \
    if (!(condition)) ::skein::throw_broken_precondition(#condition, (message), __FILE__, __LINE__); \
  } while (false)
