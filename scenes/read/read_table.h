#pragma once
#include <functional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "rules/language/key.h"
#include "scenes/problem.h"
#include "scenes/yaml/yaml_tree.h"

/// Reads mappings into the structs that a registry's tables describe.
namespace espalier::scenes {

/// What a reading leaves behind for the checks that come after it.
struct Reading {
  using Special =
      std::function<void(const YamlNode& node, const rules::Key& key, void* target, const std::string& path)>;

  Problems& problems;
  std::vector<std::string> others =
      {};                             ///< where else a misplaced key may belong: paths of the whole registry
  Special special = {};               ///< takes the kinds header, base, rules and regions
  std::set<std::string> failed = {};  ///< paths that were reported already
};

/// Sets every key that the mapping has. `path` stands before the keys' names: "" or "world.".
void readTable(const YamlNode& map, const rules::Table& table, void* target, const std::string& path,
               Reading& reading);

/// Runs the checks that do not rest on a failed key. The layers are the mappings that filled `target`, the
/// last one foremost; complaints go to the place where the key was written last.
void runChecks(const std::vector<rules::Check>& checks, const void* target,
               const std::vector<const YamlNode*>& layers, Reading& reading);

/// Where a path stands in the last of the layers that has it; as far as it leads, where none has all of it.
Place placeOf(const std::vector<const YamlNode*>& layers, std::string_view path);

/// What a key is called in Greene's paper and where it stands here: "seekprox" -> "prefer.proximity".
struct KnownAs {
  std::string name;
  std::string path;
};
/// Every path of a table: "random_tree.trials.min", "elements[].name", "cameras.<name>.eye".
std::vector<std::string> pathsOf(const rules::Table& table);
/// Greene's names in a table and the paths that they have here.
std::vector<KnownAs> greeneNames(const rules::Table& table);
/// Calls for every key of a table, with its path, parents first.
void forEachKey(const rules::Table& table,
                const std::function<void(const std::string& path, const rules::Key& key)>& visit);

}  // namespace espalier::scenes
