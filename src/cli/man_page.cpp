#include "cli/man_page.hpp"

#include <skein/core/error.hpp>
#include <skein/core/version.hpp>

#include <fmt/format.h>

#include <string_view>
#include <type_traits>
#include <utility>
#include <variant>

namespace skein {
namespace {

constexpr std::pair<ExitCode, const char*> exit_codes[] = {
    {ExitCode::done, "done"},
    {ExitCode::usage, "the command line is wrong"},
    {ExitCode::damaged_data, "a file of a run is damaged, and nothing older can serve"},
    {ExitCode::missing_input, "a file that was named is not there"},
    {ExitCode::internal, "a fault of the program"},
    {ExitCode::cannot_create, "an output cannot be created, or something is there already"},
    {ExitCode::io_error, "reading or writing failed: disk full, I/O error"},
    {ExitCode::stopped, "stopped by a signal, a file STOP or the wall time; 'skein resume' goes on"},
    {ExitCode::numerical, "the computation failed: a number that is none, a step that vanishes"},
    {ExitCode::scene_error, "the scene is wrong; every message names file, line and column"},
};

/// What man takes for its own: backslashes, dashes that are to be typed, dots and quotes that begin a line.
std::string escape(const std::string_view text) {
  std::string escaped;
  bool begins_line = true;
  for (const char c : text) {
    if (begins_line && (c == '.' || c == '\'')) escaped += "\\&";
    if (c == '\\')
      escaped += "\\e";
    else if (c == '-')
      escaped += "\\-";
    else
      escaped += c;
    begins_line = c == '\n';
  }
  return escaped;
}

/// What stands behind an option, where nothing else is said; empty for a flag.
std::string name_value(const Argument& argument) {
  if (!argument.type_name.empty()) return argument.type_name;
  if (!argument.words.empty()) return fmt::format("{}", fmt::join(argument.words, "|"));
  return std::visit(
      [](const auto& target) -> std::string {
        using Value = std::decay_t<decltype(target)>;
        if constexpr (std::is_same_v<Value, bool*>) return "";
        if constexpr (std::is_same_v<Value, Duration>) return "TIME";
        if constexpr (std::is_same_v<Value, std::string*> || std::is_same_v<Value, std::vector<std::string>*>)
          return "TEXT";
        if constexpr (std::is_same_v<Value, std::filesystem::path*>) return "FILE";
        return "NUMBER";
      },
      argument.target);
}

std::string describe(const Argument& argument) {
  std::string names = argument.names;
  if (const auto comma = names.find(','); comma != std::string::npos) names.replace(comma, 1, ", ");
  const std::string value = argument.is_option() ? name_value(argument) : "";
  return fmt::format(".TP\n\\fB{}\\fR{}\n{}\n", escape(names), value.empty() ? "" : " \\fI" + escape(value) + "\\fR",
                     escape(argument.meaning));
}

std::string describe(const Verb& verb) {
  std::string title = "skein " + verb.name, arguments;
  bool has_options = false;
  for (const Argument& argument : verb.arguments) {
    arguments += describe(argument);
    has_options |= argument.is_option();
    if (!argument.is_option())
      title += (argument.is_required ? " " : " [") + name_value(argument) + (argument.is_required ? "" : "]");
  }
  if (has_options) title += " [options]";
  return fmt::format(".SS {}\n{}.\n{}.PP\n.nf\n{}\n.fi\n", escape(title), escape(verb.summary), arguments,
                     escape(verb.footer));
}

}  // namespace

std::string write_man_page(const std::vector<Verb>& verbs) {
  std::string page = fmt::format(
      ".\\\" Made by 'skein help --man'.\n"
      ".TH SKEIN 1 \"\" \"skein {}\" \"User Commands\"\n"
      ".SH NAME\nskein \\- elastic fibers in viscous flow\n"
      ".SH SYNOPSIS\n.B skein\n\\fIverb\\fR [\\fIarguments\\fR]\n"
      ".SH DESCRIPTION\n"
      "Long, flexible, elastic fibers move in a viscous fluid, which answers their forces by regularized Stokeslets. "
      "A\n"
      "scene, a text, says what there is; a run of it is a folder, which a killed run goes on from.\n"
      ".SH VERBS\n",
      version());
  for (const Verb& verb : verbs) page += describe(verb);
  page += ".SH EXIT STATUS\n";
  for (const auto& [code, meaning] : exit_codes)
    page += fmt::format(".TP\n{}\n{}\n", static_cast<int>(code), escape(meaning));
  page +=
      ".SH ENVIRONMENT\n"
      ".TP\nOMP_NUM_THREADS\nhow many threads of the host compute, where no \\-\\-threads says so\n"
      ".SH FILES\n"
      "A run's folder holds scene.toml, trajectory.h5 (H5MD), trajectory.xdmf for ParaView, segments, checkpoints and\n"
      "logs. A file STOP in it stops the run; a file OUTPUT_NOW asks for a frame.\n";
  return page;
}

}  // namespace skein
