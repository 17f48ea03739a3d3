#pragma once

#include <CLI/App.hpp>

#include <functional>

namespace skein {

/// What the command line asks for; returns the exit code.
using Action = std::function<int()>;

/// Adds a verb with its options to the command line. When the verb is used, it sets the action.
using AddVerb = void (*)(CLI::App& app, Action& action);

void add_run_verb(CLI::App& app, Action& action);
void add_resume_verb(CLI::App& app, Action& action);
void add_verify_verb(CLI::App& app, Action& action);
void add_validate_verb(CLI::App& app, Action& action);
void add_defaults_verb(CLI::App& app, Action& action);
void add_info_verb(CLI::App& app, Action& action);
void add_analyze_verb(CLI::App& app, Action& action);
void add_reproduce_verb(CLI::App& app, Action& action);
void add_phases_verb(CLI::App& app, Action& action);
void add_field_verb(CLI::App& app, Action& action);
void add_plot_verb(CLI::App& app, Action& action);

}  // namespace skein
