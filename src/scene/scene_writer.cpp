#include <skein/scene/scene_file.hpp>
#include <skein/scene/scene_reference.hpp>

#include "repeatable_tables.hpp"
#include "scene_value.hpp"

#include <fmt/format.h>

namespace skein {
namespace {

/// Tells of tables that a reader of the defaults would otherwise take for present.
std::string describe_table(const Table& table) {
  return table.is_absent_by_default ? table.meaning + " There is none by default." : table.meaning;
}

/// Turns every value into TOML and leaves it to its kinds what to write around it.
class WritingVisitor : public KeyVisitor {
 public:
  void end_table() override {}
  void text(const Key& key, std::string& value) override { write(key, key.range.text, format_text(value)); }
  void choice(const Key& key, const std::vector<Choice>& choices, std::size_t& chosen) override {
    std::string meanings;
    for (const Choice& choice : choices) {
      meanings += fmt::format("{}{}: {}", meanings.empty() ? "" : "; ", format_text(choice.word), choice.meaning);
    }
    write(key, meanings, format_text(choices[chosen].word));
  }
  void integer(const Key& key, std::int64_t& value) override { write(key, key.range.text, std::to_string(value)); }
  void number(const Key& key, double& value) override { write(key, key.range.text, format_number(value)); }
  void vector(const Key& key, Vec3& value) override { write(key, key.range.text, format_vector(value)); }

  void profile(const Key& key, std::vector<ProfilePoint>& value) override {
    write(key, key.range.text, format_profile(value));
  }
  void numbers(const Key& key, std::vector<double>& value) override {
    write(key, key.range.text, format_numbers(value));
  }

  std::string written;

 protected:
  virtual void write(const Key& key, const std::string& range, const std::string& value) = 0;
};

class PlainWriter : public WritingVisitor {
 public:
  void begin_table(const Table& table) override {
    if (table.name.empty()) return;
    const bool is_list = table.repeatable && table.n_instances > 1;
    written += is_list ? fmt::format("\n[[{}]]\n", table.name) : fmt::format("\n[{}]\n", table.name);
  }
  // An empty list is the default, and a scene of before the key was there is the same text.
  void numbers(const Key& key, std::vector<double>& value) override {
    if (!value.empty()) WritingVisitor::numbers(key, value);
  }

 protected:
  void write(const Key& key, const std::string&, const std::string& value) override {
    written += fmt::format("{} = {}\n", key.name, value);
  }
};

class CommentedWriter : public WritingVisitor {
 public:
  void begin_table(const Table& table) override {
    if (table.name.empty()) return;
    margin_ = table.is_absent_by_default ? "# " : "";
    written += table.is_absent_by_default ? "#\n" : "\n";
    written += fmt::format("{0}# {1}\n{0}[{2}]\n", margin_, describe_table(table), table.name);
  }

 protected:
  void write(const Key& key, const std::string& range, const std::string& value) override {
    written += fmt::format("{}# {}", margin_, key.meaning);
    if (!key.unit.empty()) written += fmt::format(" [{}]", key.unit);
    written += fmt::format("{}\n{}{} = {}\n", range.empty() ? "" : " (" + range + ")", margin_, key.name, value);
  }

 private:
  std::string margin_;  ///< of each line: takes a table that the defaults lack out of what is read back
};

class MarkdownWriter : public WritingVisitor {
 public:
  void begin_table(const Table& table) override {
    const std::string heading = table.name.empty() ? "Top of the file" : fmt::format("`[{}]`", table.name);
    written += fmt::format("\n## {}\n\n{}\n\n", heading, describe_table(table));
    written += "| key | default | unit | range | meaning |\n|---|---|---|---|---|\n";
  }

 protected:
  void write(const Key& key, const std::string& range, const std::string& value) override {
    written += fmt::format("| `{}` | `{}` | {} | {} | {} |\n", key.name, value, key.unit, range, key.meaning);
  }
};

}  // namespace

std::string write_scene(const SceneConfig& scene) {
  PlainWriter writer;
  SceneConfig copy = scene;  // visitors may change what they see; this one does not
  if (copy.flows.empty()) copy.flows.push_back({.kind = FlowKind::none});  // a scene without [flow] has the default's
  visit_keys(writer, copy);
  return writer.written;
}

std::string write_commented_defaults() {
  CommentedWriter writer;
  SceneConfig scene = make_scene_with_every_table();
  visit_keys(writer, scene);
  return "# Every key of a scene and its default. Length and time are in units of your choice,\n"
         "# force in viscosity * length^2 / time. A scene needs [fiber]; all else may be left out.\n\n" +
         writer.written;
}

std::string write_markdown_reference() {
  MarkdownWriter writer;
  SceneConfig scene = make_scene_with_every_table();
  visit_keys(writer, scene);
  return "# Keys of a scene\n\n"
         "<!-- Made by `skein defaults --markdown` from the keys in src/scene: change it there. -->\n\n"
         "A scene is a file in [TOML](https://toml.io). It needs at least one `[fiber]`; every other key has a "
         "default.\n"
         "Length and time are in units of your choice, force in viscosity * length^2 / time. An unknown key is an "
         "error.\n"
         "On the command line, `--set fiber.sections=113` overrides a key.\n" +
         writer.written;
}

}  // namespace skein
