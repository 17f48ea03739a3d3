#include "cli/plot_scripts.hpp"

#include <skein/core/error.hpp>

#include "cli/child_process.hpp"
#include "cli/shared_files.hpp"
#include "skein_places.hpp"

namespace skein {

int run_plot_script(const std::string& name, std::vector<std::string> arguments) {
  // Isolated: PYTHONPATH and PYTHONHOME, which module systems set for another Python, do not matter, nor does what lies
  // in the current folder or the user's own.
  arguments.insert(arguments.begin(), {"-I", find_shared_file("plots/" + name, "tools/plots/" + name).string()});
  const int code = run_program(python_interpreter, arguments);
  // The interpreter's own codes, such as 1 after an uncaught exception, would say something else here.
  return code == 0 || code >= static_cast<int>(ExitCode::usage) ? code : static_cast<int>(ExitCode::internal);
}

}  // namespace skein
