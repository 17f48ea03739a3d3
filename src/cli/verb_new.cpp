#include <skein/core/error.hpp>
#include <skein/io/atomic_file.hpp>
#include <skein/io/folder_listing.hpp>
#include <skein/io/read_file.hpp>
#include <skein/scene/scene_file.hpp>

#include "cli/shared_files.hpp"
#include "cli/terminal.hpp"
#include "cli/verbs.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

namespace skein {
namespace {

namespace fs = std::filesystem;

constexpr const char* suffix = ".toml";

struct NewOptions {
  std::string name;
  fs::path output;
  bool is_list = false;
};

fs::path find_examples() { return find_shared_file("configs", "configs"); }

/// Names of the scenes that come with the program; none where they are not there.
std::vector<std::string> list_examples() {
  std::vector<std::string> names;
  try {
    for (const std::string& name : list_names(find_examples()))
      if (name.ends_with(suffix)) names.push_back(name.substr(0, name.size() - std::string(suffix).size()));
  } catch (const Error&) {
    return {};
  }
  std::sort(names.begin(), names.end());
  return names;
}

int print_examples() {
  const fs::path folder = find_examples();
  std::string text;
  for (const std::string& name : list_examples())
    text += fmt::format("{:<22}{}\n", name, read_scene(folder / (name + suffix), {}).config.title);
  print_result(text);
  return 0;
}

int write_example(const NewOptions& options) {
  if (options.name.empty())
    throw Error(ExitCode::usage, "name a scene, as in 'skein new tumbling'; 'skein new --list' shows them");
  const std::string text = read_file(find_examples() / (options.name + suffix));
  const fs::path output = options.output.empty() ? fs::path(options.name + suffix) : options.output;
  if (is_there(output))
    throw Error(ExitCode::cannot_create,
                fmt::format("'{}' exists; name another file by -o FILE, or remove it.", output.string()));
  write_file_atomically(output, text);
  print_result(fmt::format("{0} is written; 'skein run {0} -o {1}' simulates it\n", output.string(), options.name));
  return 0;
}

}  // namespace

Verb make_new_verb() {
  const auto options = std::make_shared<NewOptions>();
  return {"new",
          "Write a scene to start from, one of those that come with skein",
          {make_argument("name", &options->name, "NAME", "Of the scene").among(list_examples()),
           make_argument("-o,--output", &options->output, "FILE", "The file; without: NAME.toml here"),
           make_flag("--list", &options->is_list, "List the scenes with their titles")},
          "Examples:\n"
          "  skein new --list\n"
          "  skein new tumbling\n"
          "  skein new two_fibers_crossing -o crossing.toml\n"
          "Each says in comments what happens and where its numbers come from. What every key means: 'skein defaults'.",
          [options] { return options->is_list ? print_examples() : write_example(*options); }};
}

}  // namespace skein
