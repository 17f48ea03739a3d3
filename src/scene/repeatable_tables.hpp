#pragma once

#include "scene_keys.hpp"

#include <functional>
#include <string>
#include <vector>

namespace skein {

/// What a scene without a table of some name means.
enum class WhenAbsent { is_an_error, stands_for_one, stands_for_none };

/// A table that a scene may have several times. A new one is a struct in scene_config.hpp with its list in SceneConfig,
/// and a function that visits its keys and a line in repeatable_tables.cpp: what reads, overrides, writes and documents
/// scenes asks here.
struct RepeatableTable {
  std::string name;
  WhenAbsent when_absent;
  std::function<void(SceneConfig&, std::size_t n_instances)> resize;
  std::function<void(KeyVisitor&, SceneConfig&)> visit;  ///< all instances, one after the other
};

/// In the order in which scenes show them.
const std::vector<RepeatableTable>& repeatable_tables();

/// Null for any other table.
const RepeatableTable* find_repeatable_table(const std::string& name);

/// All defaults, with one instance of each repeatable table, so that its visitors meet every key there is.
SceneConfig make_scene_with_every_table();

}  // namespace skein
