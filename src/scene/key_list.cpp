#include <skein/scene/scene_reference.hpp>

#include "repeatable_tables.hpp"

#include <utility>

namespace skein {
namespace {

/// Collects the keys that it meets.
class KeyCollector : public KeyVisitor {
 public:
  void begin_table(const Table& table) override { lead_ = table.name.empty() ? "" : table.name + "."; }
  void end_table() override {}
  void text(const Key& key, std::string&) override { add(key); }
  void integer(const Key& key, std::int64_t&) override {
    add(key);
    keys.back().is_integer = true;
  }
  void number(const Key& key, double&) override { add(key); }
  void vector(const Key& key, Vec3&) override { add(key); }
  void profile(const Key& key, std::vector<ProfilePoint>&) override { add(key); }
  void numbers(const Key& key, std::vector<double>&) override { add(key); }
  void choice(const Key& key, const std::vector<Choice>& choices, std::size_t&) override {
    add(key);
    for (const Choice& choice : choices) keys.back().words.push_back(choice.word);
  }

  std::vector<KeyName> keys;

 private:
  void add(const Key& key) { keys.push_back({lead_ + key.name, {}, false}); }
  std::string lead_;
};

}  // namespace

std::vector<KeyName> list_keys() {
  KeyCollector visitor;
  SceneConfig scene = make_scene_with_every_table();
  visit_keys(visitor, scene);
  return std::move(visitor.keys);
}

}  // namespace skein
