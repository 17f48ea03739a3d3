#include "cli/parser.hpp"

#include <skein/arrays/runtime.hpp>
#include <skein/core/duration.hpp>
#include <skein/core/error.hpp>
#include <skein/scene/nearest_name.hpp>

#include "cli/terminal.hpp"
#include "mpi/launch.hpp"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <optional>
#include <sstream>
#include <string>
#include <type_traits>
#include <variant>

namespace skein {
namespace {

std::string check_duration(const std::string& text) {
  if (parse_duration(text)) return "";
  return "'" + text + "' is no duration; write seconds, or 90s, 30m, 2h, 1d, 1:30:00";
}

// Nearly always a variable of the shell that is not set; the folder, file or key that it stands for is not the one
// meant.
std::string refuse_empty(const std::string& text) {
  return text.empty() ? "nothing is written there; is a variable of the shell not set?" : "";
}

template <class Value>
constexpr bool is_text = std::is_same_v<Value, std::string> || std::is_same_v<Value, std::filesystem::path>;

/// Adds an argument to the parser's verb, as its target asks for.
class AddArgument {
 public:
  AddArgument(CLI::App& verb, const Argument& argument) : verb_(verb), argument_(argument) {}

  CLI::Option* operator()(bool* is_given) const {
    return verb_.add_flag(argument_.names, *is_given, argument_.meaning);
  }
  CLI::Option* operator()(const Duration& duration) const {
    const auto store = [duration](const std::string& text) { *duration.seconds = *parse_duration(text); };
    return verb_.add_option_function<std::string>(argument_.names, store, argument_.meaning)->check(check_duration);
  }
  CLI::Option* operator()(std::vector<std::string>* texts) const {
    return add(texts)->allow_extra_args(false)->check(refuse_empty);
  }
  CLI::Option* operator()(std::vector<double>* numbers) const {
    CLI::Option* option = limit<double>(add(numbers)->delimiter(','));
    return argument_.count > 0 ? option->expected(argument_.count) : option;
  }
  template <class Value>
  CLI::Option* operator()(Value* value) const {
    CLI::Option* option = add(value);
    if constexpr (is_text<Value>) option->check(refuse_empty);
    if constexpr (std::is_arithmetic_v<Value>) return limit<Value>(option);
    return option;
  }
  CLI::Option* operator()(std::optional<double>* value) const { return limit<double>(add(value)); }
  CLI::Option* operator()(std::optional<std::int64_t>* value) const { return limit<std::int64_t>(add(value)); }

 private:
  template <class Value>
  CLI::Option* add(Value* value) const {
    return verb_.add_option(argument_.names, *value, argument_.meaning);
  }

  /// Refuses what is not within the argument's bounds; not a number is within none.
  template <class Number>
  CLI::Option* limit(CLI::Option* option) const {
    if (!argument_.bounds) return option;
    const CLI::Range range(static_cast<Number>(argument_.bounds->first), static_cast<Number>(argument_.bounds->second));
    const auto refuse_nan = [](const std::string& text) {
      Number number{};
      return CLI::detail::lexical_cast(text, number) && number != number ? "not a number is no value" : "";
    };
    option->check(refuse_nan);
    return option->check(range);
  }

  CLI::App& verb_;
  const Argument& argument_;
};

void add_argument(CLI::App& verb, const Argument& argument) {
  CLI::Option* option = std::visit(AddArgument(verb, argument), argument.target);
  option->required(argument.is_required);
  if (!argument.type_name.empty()) option->type_name(argument.type_name);
  if (!argument.words.empty()) option->check(CLI::IsMember(argument.words));
  if (!argument.excluded.empty()) option->excludes(argument.excluded);
}

void add_verb(CLI::App& app, const Verb& verb) {
  CLI::App* added = app.add_subcommand(verb.name, verb.summary);
  for (const Argument& argument : verb.arguments) add_argument(*added, argument);
  added->footer(verb.footer);
}

void describe_program(CLI::App& app) {
  std::string build = describe_build();
  while (!build.empty() && build.back() == '\n') build.pop_back();
  build += "\nMPI: " + describe_mpi();
  app.set_version_flag("-V,--version", build, "Print version, commit, compiler and Kokkos backends");
  app.require_subcommand(1);
  app.footer(
      "Examples:\n"
      "  skein defaults > scene.toml      a scene with every key, explained\n"
      "  skein validate scene.toml        look for mistakes\n"
      "  skein run scene.toml -o result   simulate into the folder 'result'\n"
      "  skein plot result                draw it\n"
      "'skein help VERB' and 'skein VERB --help' explain a verb.");
}

std::string suggest(const std::string& name, const std::vector<std::string>& known) {
  const std::string nearest = find_nearest_name(name, known);
  return nearest.empty() ? "" : fmt::format("; did you mean '{}'?", nearest);
}

// Before parsing: the parser would only say that a verb is missing.
void check_verb_name(const int n_arguments, char** arguments, const std::vector<Verb>& verbs) {
  const std::string first = n_arguments > 1 ? arguments[1] : "";
  if (first.empty() || first[0] == '-') return;
  std::vector<std::string> names;
  for (const Verb& verb : verbs) names.push_back(verb.name);
  if (std::find(names.begin(), names.end(), first) != names.end()) return;
  throw Error(ExitCode::usage,
              fmt::format("unknown verb '{}'{}\n'skein --help' lists the verbs", first, suggest(first, names)));
}

// The parser would take the next word for what "--output=" does not say.
void check_values(const int n_arguments, char** arguments) {
  for (int i = 1; i < n_arguments; ++i) {
    const std::string word = arguments[i];
    if (word == "--") return;
    if (word.starts_with("--") && word.find('=') == word.size() - 1)
      throw Error(ExitCode::usage, fmt::format("{} {}", word, refuse_empty("")));
  }
}

std::vector<std::string> list_flags(const CLI::App& app) {
  std::vector<std::string> flags;
  for (const CLI::Option* option : app.get_options()) {
    for (const auto& name : option->get_snames()) flags.push_back("-" + name);
    for (const auto& name : option->get_lnames()) flags.push_back("--" + name);
  }
  return flags;
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

/// The verb's own action, unless several processes were started that would all do the same. One of them says so.
std::function<int()> refuse_ranks(const Verb& verb) {
  const Launch launch = find_launch();
  if (launch.size <= 1) return verb.run;
  if (launch.rank > 0) return [] { return static_cast<int>(ExitCode::usage); };
  throw Error(ExitCode::usage,
              fmt::format("{} ranks were started, and 'skein {}' has no use for them: start it without "
                          "mpirun; 'run' and 'resume' take ranks",
                          launch.size, verb.name));
}

}  // namespace

std::function<int()> parse_command_line(const int n_arguments, char** arguments, const std::vector<Verb>& verbs) {
  CLI::App app("Elastic fibers in viscous flow.", "skein");
  describe_program(app);
  for (const Verb& verb : verbs) add_verb(app, verb);
  check_verb_name(n_arguments, arguments, verbs);
  check_values(n_arguments, arguments);
  try {
    app.parse(n_arguments, arguments);
  } catch (const CLI::ParseError& error) {
    if (error.get_exit_code() != 0) throw Error(ExitCode::usage, describe_parse_error(app, error));
    std::ostringstream text;  // of --help or --version
    app.exit(error, text, text);
    return [text = text.str()] {
      print_result(text);
      return 0;
    };
  }
  const std::string name = app.get_subcommands().front()->get_name();
  const auto verb = std::find_if(verbs.begin(), verbs.end(), [&](const Verb& one) { return one.name == name; });
  return verb->takes_ranks ? verb->run : refuse_ranks(*verb);
}

}  // namespace skein
