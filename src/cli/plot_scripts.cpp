#include "cli/plot_scripts.hpp"

#include <skein/core/error.hpp>

#include "cli/child_process.hpp"

#include <fmt/format.h>

#include <filesystem>
#include <system_error>

namespace skein {
namespace {

namespace fs = std::filesystem;

// Beside an installed program, else in the sources that this program was built from.
fs::path find_script(const std::string& name) {
  std::error_code error;
  const fs::path program = fs::read_symlink("/proc/self/exe", error);
  const fs::path places[] = {program.parent_path() / SKEIN_PLOTS_FROM_PROGRAM, SKEIN_PLOTS_IN_SOURCES};
  for (const fs::path& place : places) {
    const fs::path script = (place / name).lexically_normal();
    if (fs::is_regular_file(script, error)) return script;
  }
  throw Error(ExitCode::missing_input, fmt::format("the plot script {} is neither in {} nor in {}", name,
                                                   places[0].lexically_normal().string(), places[1].string()));
}

}  // namespace

int run_plot_script(const std::string& name, std::vector<std::string> arguments) {
  // Isolated: PYTHONPATH and PYTHONHOME, which module systems set for another Python, do not matter, nor does what lies
  // in the current folder or the user's own.
  arguments.insert(arguments.begin(), {"-I", find_script(name).string()});
  const int code = run_program(SKEIN_PYTHON, arguments);
  // The interpreter's own codes, such as 1 after an uncaught exception, would say something else here.
  return code == 0 || code >= static_cast<int>(ExitCode::usage) ? code : static_cast<int>(ExitCode::internal);
}

}  // namespace skein
