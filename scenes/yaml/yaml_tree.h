#pragma once
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "scenes/problem.h"

/// A YAML file as a tree of plain nodes with their places, read through yaml-cpp's events and checked for all
/// that yaml-cpp 0.7 lets through: repeated keys, anchors and aliases, foreign tags, quotes left open over
/// lines, deep nesting, several documents.
namespace espalier::scenes {

struct YamlEntry;

struct YamlNode {
  enum class Kind { null, scalar, list, map };
  Kind kind = Kind::null;
  Place place;
  std::string text;                ///< scalar
  bool quoted = false;             ///< scalar: written in quotes or as a block
  bool refused = false;            ///< a problem was reported: say no more about it
  std::vector<YamlNode> items;     ///< list
  std::vector<YamlEntry> entries;  ///< map, in the order of the file; no key twice

  /// Null where there is no such key or this is no mapping.
  const YamlEntry* entry(std::string_view key) const;
};

struct YamlEntry {
  std::string key;
  Place place;  ///< of the key
  YamlNode value;
};

inline constexpr std::size_t kMaxDepth = 64;
inline constexpr std::size_t kMaxNodes = 200'000;

/// The file's root mapping, or null where it cannot be made out. Where there were problems (a key given
/// twice) the rest may still be read, to find more. `shown` names the file in messages.
std::shared_ptr<const YamlNode> parseYaml(const std::string& text, const std::string& shown,
                                          Problems& problems);

/// "'text'", "a list", "a mapping" or "nothing": what a message calls a node.
std::string described(const YamlNode& node);

}  // namespace espalier::scenes
