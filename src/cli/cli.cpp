#include "cli/cli.hpp"

#include <skein/arrays/runtime.hpp>
#include <skein/core/error.hpp>
#include <skein/scene/nearest_name.hpp>

#include "cli/terminal.hpp"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <exception>
#include <new>
#include <string>
#include <system_error>

namespace skein {
namespace {

std::string suggest(const std::string& name, const std::vector<std::string>& known) {
  const std::string nearest = find_nearest_name(name, known);
  return nearest.empty() ? "" : fmt::format("; did you mean '{}'?", nearest);
}

std::vector<std::string> list_verbs(const CLI::App& app) {
  std::vector<std::string> names;
  for (const CLI::App* verb : app.get_subcommands({})) names.push_back(verb->get_name());
  return names;
}

std::vector<std::string> list_flags(const CLI::App& app) {
  std::vector<std::string> flags;
  for (const CLI::Option* option : app.get_options()) {
    for (const auto& name : option->get_snames()) flags.push_back("-" + name);
    for (const auto& name : option->get_lnames()) flags.push_back("--" + name);
  }
  return flags;
}

// Looked for before parsing: the parser would only say that a verb is missing.
std::string find_unknown_verb(const CLI::App& app, const int n_arguments, char** arguments) {
  const auto verbs = list_verbs(app);
  const std::string first = n_arguments > 1 ? arguments[1] : "";
  if (first.empty() || first[0] == '-' || std::find(verbs.begin(), verbs.end(), first) != verbs.end()) return "";
  return first;
}

std::string describe_parse_error(const CLI::App& app, const CLI::ParseError& error) {
  const auto used = app.get_subcommands();
  const CLI::App& verb = used.empty() ? app : *used.front();
  // Named before anything that is missing: a mistyped option leaves the right one missing.
  std::string message = error.what();
  const auto extras = app.remaining(true);
  if (!extras.empty()) {
    const std::string& extra = extras.front();
    const std::string name = extra.substr(0, extra.find('='));
    message = extra[0] == '-' ? fmt::format("unknown option '{}'{}", name, suggest(name, list_flags(verb)))
                              : fmt::format("unexpected argument '{}'", extra);
  }
  return fmt::format("{}\n'skein {}--help' shows what can be written", message,
                     used.empty() ? "" : verb.get_name() + " ");
}

int reject(const std::string& message) {
  print_error(message);
  return static_cast<int>(ExitCode::usage);
}

[[noreturn]] void throw_unwritable_output(const int error) {
  throw Error(ExitCode::io_error, fmt::format("standard output cannot be written: {}", std::strerror(error)));
}

int run_parsed(const Action& action) {
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

int parse_and_run(CLI::App& app, const Action& action, const int n_arguments, char** arguments) {
  if (const std::string verb = find_unknown_verb(app, n_arguments, arguments); !verb.empty()) {
    return reject(
        fmt::format("unknown verb '{}'{}\n'skein --help' lists the verbs", verb, suggest(verb, list_verbs(app))));
  }
  try {
    app.parse(n_arguments, arguments);
  } catch (const CLI::ParseError& error) {
    if (error.get_exit_code() == 0) return app.exit(error);  // --help and --version
    return reject(describe_parse_error(app, error));
  }
  return run_parsed(action);
}

int report_internal(const std::string& what) {
  print_error(fmt::format("internal error: {}\nplease report it with the command and the scene", what));
  return static_cast<int>(ExitCode::internal);
}

}  // namespace

int run_command_line(const int n_arguments, char** arguments, const std::vector<AddVerb>& verbs) {
  try {
    CLI::App app("Elastic fibers in viscous flow.", "skein");
    std::string build = describe_build();
    while (!build.empty() && build.back() == '\n') build.pop_back();
    app.set_version_flag("--version", build, "Print version, commit, compiler and Kokkos backends");
    app.require_subcommand(1);
    app.footer(
        "Examples:\n"
        "  skein defaults > scene.toml      a scene with every key, explained\n"
        "  skein validate scene.toml        look for mistakes\n"
        "  skein run scene.toml -o result   simulate into the folder 'result'\n"
        "  skein plot result                draw it\n"
        "'skein VERB --help' explains a verb.");
    Action action;
    for (const AddVerb add_verb : verbs) add_verb(app, action);
    return parse_and_run(app, action, n_arguments, arguments);
  } catch (const Error& error) {
    if (error.code() == ExitCode::internal) return report_internal(error.what());
    print_error(error.what());
    return static_cast<int>(error.code());
  } catch (const std::bad_alloc&) {
    return report_internal("there is not enough memory");
  } catch (const std::exception& error) {
    return report_internal(error.what());
  }
}

}  // namespace skein
