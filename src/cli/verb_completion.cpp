#include <skein/scene/scene_reference.hpp>

#include "cli/completion.hpp"
#include "cli/terminal.hpp"
#include "cli/verbs.hpp"

#include <memory>
#include <string>

namespace skein {

Verb make_completion_verb(const std::vector<Verb>& verbs) {
  const auto shell = std::make_shared<std::string>();
  return {"completion",
          "Print a script that completes skein's command line in a shell",
          {make_argument("shell", shell.get(), "", "Which shell").require().among({"bash"})},
          "Examples:\n"
          "  source <(skein completion bash)      in this shell, or in every one by this line in ~/.bashrc\n"
          "An installed skein needs neither: the script is where bash-completion looks for it.",
          [shell, &verbs] {  // bash is all that it can be
            print_result(write_bash_completion(verbs, list_keys()));
            return 0;
          }};
}

}  // namespace skein
