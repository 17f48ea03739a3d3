#include "cli/cli.hpp"

#include <skein/core/error.hpp>
#include <skein/core/resource_error.hpp>

#include "cli/parser.hpp"
#include "cli/terminal.hpp"
#include "cli/verbs.hpp"

#include <fmt/format.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <exception>
#include <filesystem>
#include <new>
#include <string>
#include <system_error>

namespace skein {
namespace {

[[noreturn]] void throw_unwritable_output(const int error) {
  throw Error(ExitCode::io_error, fmt::format("standard output cannot be written: {}", std::strerror(error)));
}

int run_action(const std::function<int()>& action) {
  int code = 0;
  try {
    code = action();
  } catch (const std::system_error& error) {  // from fmt, where more is printed than a buffer holds
    if (std::ferror(stdout) == 0) throw;
    throw_unwritable_output(error.code().value());
  }
  if (std::fflush(stdout) != 0) throw_unwritable_output(errno);
  return code;
}

int report_internal(const std::string& what) {
  print_error(fmt::format("internal error: {}\nplease report it with the command and the scene", what));
  return static_cast<int>(ExitCode::internal);
}

}  // namespace

int run_command_line(const int n_arguments, char** arguments, const std::vector<Verb (*)()>& make_verbs) {
  try {
    std::vector<Verb> verbs;
    for (const auto make_verb : make_verbs) verbs.push_back(make_verb());
    verbs.push_back(make_help_verb(verbs));
    verbs.push_back(make_completion_verb(verbs));
    return run_action(parse_command_line(n_arguments, arguments, verbs));
  } catch (const Error& error) {
    if (error.code() == ExitCode::internal) return report_internal(error.what());
    print_error(error.what());
    return static_cast<int>(error.code());
  } catch (const std::filesystem::filesystem_error& error) {
    print_error(fmt::format("'{}': {}", error.path1().string(), error.code().message()));
    return static_cast<int>(ExitCode::io_error);
  } catch (const std::bad_alloc&) {
    print_error("there is not enough memory; ask for fewer nodes, frames or points, or use a machine with more");
    return static_cast<int>(ResourceError::exit_code);
  } catch (const std::exception& error) {
    return report_internal(error.what());
  }
}

}  // namespace skein
