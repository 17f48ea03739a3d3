#include "cli/parser.hpp"
#include "cli/verbs.hpp"

#include <memory>
#include <string>
#include <vector>

namespace skein {
namespace {

/// As if --help were asked for, so that there is one help text.
int print_help(std::string name, const std::vector<Verb>& verbs) {
  std::string program = "skein", flag = "--help";
  std::vector<char*> arguments{program.data()};
  if (!name.empty()) arguments.push_back(name.data());
  arguments.push_back(flag.data());
  return parse_command_line(static_cast<int>(arguments.size()), arguments.data(), verbs)();
}

}  // namespace

Verb make_help_verb(const std::vector<Verb>& verbs) {
  const auto name = std::make_shared<std::string>();
  return {"help",
          "Explain a verb",
          {make_argument("verb", name.get(), "VERB", "The verb; without: list them")},
          "Examples:\n"
          "  skein help run",
          [name, &verbs] { return print_help(*name, verbs); }};
}

}  // namespace skein
