#include "cli/cli.hpp"
#include "cli/process_start.hpp"
#include "cli/thread_waiting.hpp"
#include "cli/verbs.hpp"
#include "mpi/launch.hpp"
#include "runs/test_order.hpp"

int main(int argc, char** argv) {
  skein::prepare_process();
  skein::limit_thread_spinning(argv);
  skein::install_kill_order();
  return skein::leave_ranks(skein::run_command_line(
      argc, argv,
      {skein::make_run_verb, skein::make_resume_verb, skein::make_verify_verb, skein::make_validate_verb,
       skein::make_defaults_verb, skein::make_new_verb, skein::make_info_verb, skein::make_analyze_verb,
       skein::make_phases_verb, skein::make_plan_verb, skein::make_bench_verb, skein::make_field_verb,
       skein::make_plot_verb, skein::make_view_verb, skein::make_report_verb, skein::make_reproduce_verb,
       skein::make_sweep_verb}));
}
