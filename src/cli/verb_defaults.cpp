#include <skein/scene/scene_reference.hpp>

#include "cli/verbs.hpp"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <memory>

namespace skein {

void add_defaults_verb(CLI::App& app, Action& action) {
  CLI::App* verb = app.add_subcommand("defaults", "Print a scene with every key at its default, explained");
  const auto as_markdown = std::make_shared<bool>(false);
  verb->add_flag("--markdown", *as_markdown, "Print the reference page in Markdown instead");
  verb->footer(
      "Examples:\n"
      "  skein defaults > scene.toml\n"
      "  skein defaults --markdown > docs/scene.md");
  verb->callback([as_markdown, &action] {
    action = [as_markdown] {
      fmt::print("{}", *as_markdown ? write_markdown_reference() : write_commented_defaults());
      return 0;
    };
  });
}

}  // namespace skein
