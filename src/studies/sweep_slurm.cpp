#include "studies/sweep_slurm.hpp"

#include <fmt/format.h>

#include <filesystem>
#include <string_view>

namespace skein {
namespace {

/// For bash, whatever is in it.
std::string quote(const std::string& text) {
  std::string quoted = "'";
  for (const char c : text) quoted += c == '\'' ? "'\\''" : std::string(1, c);
  return quoted + "'";
}

constexpr std::string_view script = R"bash(#!/bin/bash
#SBATCH --job-name=skein-sweep
#SBATCH --array=1-{n_tasks}
#SBATCH --ntasks=1
#SBATCH --cpus-per-task=1
#SBATCH --requeue
#SBATCH --open-mode=append
#SBATCH --signal=B:USR1@120
# {n_runs} runs in {n_tasks} tasks. Options of sbatch before this file's name, such as --time=8:00:00, --cpus-per-task=4 or
# --partition=NAME, come before those above. Two minutes before its time is over a task stops with checkpoints and queues
# itself again; one that is cancelled stops, too, and does not.

folder={folder}
skein={program}
"$skein" sweep -o "$folder" --shard "$SLURM_ARRAY_TASK_ID/{n_tasks}" --threads "${{SLURM_CPUS_PER_TASK:-1}}" &
child=$!
is_late=
trap 'is_late=yes; kill -TERM "$child" 2> /dev/null' USR1
trap 'kill -TERM "$child" 2> /dev/null' TERM
wait "$child"
code=$?
while kill -0 "$child" 2> /dev/null; do  # a signal has ended the waiting, not the sweep
  wait "$child"
  code=$?
done
if [[ $code == 75 && -n $is_late ]]; then
  scontrol requeue "${{SLURM_ARRAY_JOB_ID}}_$SLURM_ARRAY_TASK_ID"
fi
exit "$code"
)bash";

}  // namespace

std::string write_slurm_script(const Sweep& sweep, const std::string& program, const int n_tasks) {
  return fmt::format(fmt::runtime(script), fmt::arg("n_tasks", n_tasks), fmt::arg("n_runs", sweep.runs.names.size()),
                     fmt::arg("folder", quote(std::filesystem::absolute(sweep.folder.path).string())),
                     fmt::arg("program", quote(program)));
}

}  // namespace skein
