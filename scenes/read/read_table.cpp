#include "scenes/read/read_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>

#include "rules/language/registry.h"
#include "scenes/yaml/yaml_hints.h"
#include "scenes/yaml/yaml_value.h"

namespace espalier::scenes {
namespace {

using rules::Key;
using rules::Kind;
using rules::Table;

std::vector<std::string> namesOf(const Table& table) {
  std::vector<std::string> names;
  for (const auto& key : table.keys) names.push_back(key.name);
  return names;
}

/// The last step of a path: "trials.min" -> "min".
std::string_view leaf(std::string_view path) {
  return path.substr(path.find_last_of('.') + 1);
}

/// Where a key that is unknown here may belong: it has Greene's name, or stands in the wrong mapping.
std::string whereItBelongs(const std::string& word, const Table& table, const Reading& reading) {
  static const auto greene = greeneNames(rules::ruleTable());
  for (const auto& [name, path] : greene) {
    if (name != word || name == leaf(path)) continue;
    if (std::find(reading.others.begin(), reading.others.end(), path) == reading.others.end()) continue;
    return fmt::format("; did you mean '{}' (Greene's {})?", path, name);
  }
  if (auto spaced = spacedColon(word, namesOf(table)); !spaced.empty()) return spaced;
  const auto near = didYouMean(word, namesOf(table));
  if (!near.empty()) return near;
  for (const auto& path : reading.others) {
    if (leaf(path) == word) return fmt::format("; did you mean '{}'?", path);
  }
  return "";
}

class TableReader {
 public:
  explicit TableReader(Reading& reading) : reading_(reading) {}

  void read(const YamlNode& map, const Table& table, void* target, const std::string& prefix) {
    for (const auto& entry : map.entries) {
      if (reading_.problems.full()) return;
      const Key* key = rules::find(table, entry.key);
      if (!key) {
        reading_.problems.add(
            entry.place, fmt::format("unknown key {}; expected one of {}{}", inQuotes(entry.key),
                                     listed(namesOf(table)), whereItBelongs(entry.key, table, reading_)));
        continue;
      }
      readKey(entry.value, *key, target, prefix + entry.key);
    }
    for (const auto& key : table.keys) {
      if (!key.required || map.entry(key.name)) continue;
      reading_.problems.add(map.place, fmt::format("the key '{}' is missing here; expected {}", key.name,
                                                   rules::expectation(key)));
      reading_.failed.insert(prefix + key.name);
    }
  }

 private:
  void readKey(const YamlNode& node, const Key& key, void* target, const std::string& path) {
    switch (key.kind) {
      case Kind::header:
      case Kind::base:
      case Kind::rules:
      case Kind::regions:
        return reading_.special(node, key, target, path);
      case Kind::section:
        return readMapping(node, key, key.open(target), path);
      case Kind::entries:
        return readEntries(node, key, target, path);
      case Kind::named:
        return readNamed(node, key, target, path);
      default:
        break;
    }
    if (const auto datum = readDatum(node, key, path, reading_.problems)) {
      key.set(target, *datum);
    } else {
      reading_.failed.insert(path);
    }
  }

  void fail(const YamlNode& node, const Key& key, const std::string& path) {
    if (!node.refused) {
      const auto is = node.kind == YamlNode::Kind::null ? "has no value" : "is " + described(node);
      reading_.problems.add(node.place, fmt::format("{} {}; expected {}{}", path, is, rules::expectation(key),
                                                    spacedColon(node.text, namesOf(*key.child))));
    }
    reading_.failed.insert(path);
  }

  /// A mapping for key.child, or the value of the key that its shorthand names.
  void readMapping(const YamlNode& node, const Key& key, void* target, const std::string& path) {
    const Key* brief = rules::briefOf(key);
    const bool is_curve = brief && brief->kind == Kind::value && (node.entry("over") || node.entry("points"));
    if (node.kind == YamlNode::Kind::map && !is_curve) return read(node, *key.child, target, path + ".");
    if (brief && node.kind != YamlNode::Kind::null)
      return readKey(node, *brief, target, path + "." + brief->name);
    fail(node, key, path);
  }

  /// One of several mappings of `key`.
  void readItem(const YamlNode& node, const Key& key, void* target, const std::string& path) {
    auto item = key;
    item.kind = Kind::section;
    readMapping(node, item, target, path);
  }

  void readEntries(const YamlNode& node, const Key& key, void* target, const std::string& path) {
    if (node.kind != YamlNode::Kind::list) return fail(node, key, path);
    if (!roomFor(node, node.items.size(), key, path)) return;
    if (lacksBrackets(node, key)) return failBrackets(node, key, path);
    key.clear(target);
    for (std::size_t i = 0; i < node.items.size(); ++i) {
      readItem(node.items[i], key, key.append(target, ""), fmt::format("{}[{}]", path, i));
    }
  }

  /// A level of brackets was forgotten: [x, y, z] in place of [[x, y, z]]. Said once, not for every number.
  static bool lacksBrackets(const YamlNode& node, const Key& key) {
    const Key* brief = rules::briefOf(key);
    return brief && (brief->kind == Kind::place || brief->kind == Kind::point) && !node.items.empty() &&
           std::all_of(node.items.begin(), node.items.end(),
                       [](const auto& item) { return item.kind == YamlNode::Kind::scalar; });
  }

  void failBrackets(const YamlNode& node, const Key& key, const std::string& path) {
    reading_.problems.add(
        node.place,
        fmt::format("{} has a list of single values where a list of points should stand; expected {}", path,
                    rules::expectation(key)));
    reading_.failed.insert(path);
  }

  void readNamed(const YamlNode& node, const Key& key, void* target, const std::string& path) {
    if (node.kind != YamlNode::Kind::map) return fail(node, key, path);
    if (!roomFor(node, node.entries.size(), key, path)) return;
    key.clear(target);
    for (const auto& entry : node.entries) {
      readItem(entry.value, key, key.append(target, entry.key), path + "." + entry.key);
    }
  }

  bool roomFor(const YamlNode& node, std::size_t count, const Key& key, const std::string& path) {
    if (key.most == 0 || count <= key.most) return true;
    reading_.problems.add(node.place,
                          fmt::format("{} has {} entries; expected at most {}", path, count, key.most));
    reading_.failed.insert(path);
    return false;
  }

  Reading& reading_;
};

/// Splits "plants[2].seeds[5]" into plants, 2, seeds, 5.
std::vector<std::string_view> steps(std::string_view path) {
  std::vector<std::string_view> all;
  while (!path.empty()) {
    const auto end = std::min(path.find_first_of(".[]"), path.size());
    if (end > 0) all.push_back(path.substr(0, end));
    path.remove_prefix(std::min(end + 1, path.size()));
  }
  return all;
}

struct Found {
  Place place;
  std::size_t depth = 0;  ///< steps of the path that are there
  bool whole = false;
};

/// How far a path leads into a mapping, and the place of its last step there.
Found locate(const YamlNode& root, std::string_view path) {
  Found found{root.place, 0, false};
  const YamlNode* node = &root;
  const auto way = steps(path);
  for (const auto step : way) {
    if (node->kind == YamlNode::Kind::list) {
      std::size_t index = 0;
      const auto [end, error] = std::from_chars(step.data(), step.data() + step.size(), index);
      if (error != std::errc{} || end != step.data() + step.size() || index >= node->items.size())
        return found;
      node = &node->items[index];
      found.place = node->place;
    } else {
      const auto* entry = node->entry(step);
      if (!entry) return found;
      node = &entry->value;
      found.place = node->kind == YamlNode::Kind::scalar ? node->place : entry->place;
    }
    ++found.depth;
  }
  found.whole = true;
  return found;
}

/// Is one path the other's beginning?
bool overlap(std::string_view a, std::string_view b) {
  const auto shorter = std::min(a.size(), b.size());
  if (a.substr(0, shorter) != b.substr(0, shorter)) return false;
  const auto rest = a.size() > b.size() ? a.substr(shorter) : b.substr(shorter);
  return rest.empty() || rest.front() == '.' || rest.front() == '[';
}

}  // namespace

void readTable(const YamlNode& map, const Table& table, void* target, const std::string& path,
               Reading& reading) {
  TableReader(reading).read(map, table, target, path);
}

Place placeOf(const std::vector<const YamlNode*>& layers, std::string_view path) {
  Found best{layers.back()->place, 0, false};
  for (auto layer = layers.rbegin(); layer != layers.rend(); ++layer) {
    const auto found = locate(**layer, path);
    if (found.whole) return found.place;
    if (found.depth > best.depth) best = found;
  }
  return best.place;
}

void runChecks(const std::vector<rules::Check>& checks, const void* target,
               const std::vector<const YamlNode*>& layers, Reading& reading) {
  const auto hasFailed = [&](std::string_view path) {
    return std::any_of(reading.failed.begin(), reading.failed.end(),
                       [&](const auto& f) { return overlap(f, path); });
  };
  const auto given = [&](std::string_view path) {
    const auto last = std::find_if(layers.rbegin(), layers.rend(),
                                   [&](const auto* layer) { return locate(*layer, path).whole; });
    return static_cast<int>(layers.rend() - last);
  };
  const rules::Check::Complain complain{
      [&](const std::string& path, const std::string& text, const rules::Check::Misnamed& misnamed) {
        if (!hasFailed(path))
          reading.problems.add(placeOf(layers, path), text + didYouMean(misnamed.name, misnamed.known));
      }};
  for (const auto& check : checks) {
    if (std::none_of(check.reads.begin(), check.reads.end(), hasFailed)) check.run(target, given, complain);
  }
}

void forEachKey(const Table& table, const std::function<void(const std::string&, const Key&)>& visit) {
  const std::function<void(const Table&, const std::string&)> walk = [&](const Table& t,
                                                                         const std::string& prefix) {
    for (const auto& key : t.keys) {
      visit(prefix + key.name, key);
      if (key.kind == Kind::section) walk(*key.child, prefix + key.name + ".");
      if (key.kind == Kind::entries) walk(*key.child, prefix + key.name + "[].");
      if (key.kind == Kind::named) walk(*key.child, prefix + key.name + ".<name>.");
    }
  };
  walk(table, "");
}

std::vector<std::string> pathsOf(const Table& table) {
  std::vector<std::string> paths;
  forEachKey(table, [&](const std::string& path, const Key&) { paths.push_back(path); });
  return paths;
}

std::vector<KnownAs> greeneNames(const Table& table) {
  std::vector<KnownAs> names;
  forEachKey(table, [&](const std::string& path, const Key& key) {
    if (!key.greene.empty()) names.push_back({key.greene, path});
  });
  return names;
}

}  // namespace espalier::scenes
