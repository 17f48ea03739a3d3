#include <skein/scene/scene_reference.hpp>

#include "cli/terminal.hpp"
#include "cli/verbs.hpp"

#include <memory>

namespace skein {

Verb make_defaults_verb() {
  const auto as_markdown = std::make_shared<bool>(false);
  return {"defaults",
          "Print a scene with every key at its default, explained",
          {make_flag("--markdown", as_markdown.get(), "Print the reference page in Markdown instead")},
          "Examples:\n"
          "  skein defaults > scene.toml\n"
          "  skein defaults --markdown > docs/scene.md",
          [as_markdown] {
            print_result(*as_markdown ? write_markdown_reference() : write_commented_defaults());
            return 0;
          }};
}

}  // namespace skein
