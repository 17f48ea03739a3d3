#include "cli/common_arguments.hpp"

#include <skein/arrays/runtime.hpp>

namespace skein {

Argument make_scene_argument(std::string* scene) {
  return make_argument("scene", scene, "SCENE", "Scene file (TOML)").require();
}

Argument make_folder_argument(std::string* folder) {
  return make_argument("folder", folder, "DIR", "Run folder").require();
}

Argument make_overrides_option(std::vector<std::string>* overrides) {
  return make_argument("--set", overrides, "KEY=VALUE", "Override a key of the scene; may be repeated");
}

Argument make_threads_option(int* threads) {
  return make_argument("--threads", threads, "N", "Threads of the host (default: OMP_NUM_THREADS or all cores)")
      .within(1, most_host_threads);
}

Argument make_rung_option(std::string* rung, const std::string& meaning) {
  return make_argument(
      "--rung", rung, "RUNG",
      meaning + ": rigid, chain, or nodes on a section; length, rigidity and what a fiber is to the fluid stay");
}

Argument make_jobs_option(int* jobs) {
  return make_argument("--jobs", jobs, "N", "Runs at a time (default: one for each thread)")
      .within(1, most_host_threads);
}

Argument make_walltime_option(double* seconds) {
  return make_argument("--max-walltime", Duration{seconds}, "T",
                       "Stop in time, with a checkpoint: seconds, 30m, 2h or 1:30:00");
}

Argument make_quiet_flag(bool* quiet) { return make_flag("-q,--quiet", quiet, "Errors only"); }

}  // namespace skein
