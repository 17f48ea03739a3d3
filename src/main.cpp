#include "cli/cli.hpp"
#include "cli/thread_waiting.hpp"
#include "runs/test_order.hpp"

int main(int argc, char** argv) {
  skein::limit_thread_spinning(argv);
  skein::install_kill_order();
  return skein::run_command_line(
      argc, argv,
      {skein::add_run_verb, skein::add_resume_verb, skein::add_verify_verb, skein::add_validate_verb,
       skein::add_defaults_verb, skein::add_info_verb, skein::add_analyze_verb, skein::add_phases_verb,
       skein::add_field_verb, skein::add_plot_verb, skein::add_reproduce_verb});
}
