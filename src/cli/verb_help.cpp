#include "cli/man_page.hpp"
#include "cli/parser.hpp"
#include "cli/terminal.hpp"
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
  const auto as_man_page = std::make_shared<bool>(false);
  return {"help",
          "Explain a verb",
          {make_argument("verb", name.get(), "VERB", "The verb; without: list them"),
           make_flag("--man", as_man_page.get(), "Print the manual's page, of all verbs, in place of that")},
          "Examples:\n"
          "  skein help run\n"
          "  skein help --man > skein.1\n"
          "An installed skein has the page: 'man skein'.",
          [name, as_man_page, &verbs] {
            if (!*as_man_page) return print_help(*name, verbs);
            print_result(write_man_page(verbs));
            return 0;
          }};
}

}  // namespace skein
