#pragma once

#include "cli/verb.hpp"

#include <string>
#include <vector>

namespace skein {

/// The manual's page skein(1), in the language of man (groff_man(7)): verbs, arguments, examples, exit codes, files.
std::string write_man_page(const std::vector<Verb>& verbs);

}  // namespace skein
