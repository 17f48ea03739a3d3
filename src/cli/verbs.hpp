#pragma once

#include "cli/verb.hpp"

#include <vector>

namespace skein {

Verb make_run_verb();
Verb make_resume_verb();
Verb make_verify_verb();
Verb make_validate_verb();
Verb make_defaults_verb();
Verb make_new_verb();
Verb make_info_verb();
Verb make_analyze_verb();
Verb make_reproduce_verb();
Verb make_phases_verb();
Verb make_bench_verb();
Verb make_plan_verb();
Verb make_field_verb();
Verb make_plot_verb();
Verb make_view_verb();
Verb make_report_verb();
Verb make_sweep_verb();

/// These two tell of all verbs, themselves included. @param verbs  must outlive them
Verb make_help_verb(const std::vector<Verb>& verbs);
Verb make_completion_verb(const std::vector<Verb>& verbs);

}  // namespace skein
