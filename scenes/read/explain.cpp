#include "scenes/read/explain.h"

#include <fmt/format.h>

#include <algorithm>
#include <vector>

#include "rules/language/registry.h"
#include "scenes/problem.h"
#include "scenes/read/read_table.h"
#include "scenes/read/registry.h"
#include "sim/base/error.h"

namespace espalier::scenes {
namespace {

using rules::Key;

/// A path as one says it: without the marks of lists and names.
std::string spoken(std::string path) {
  for (const std::string mark : {".<name>", "[]"}) {
    for (auto at = path.find(mark); at != path.npos; at = path.find(mark)) path.erase(at, mark.size());
  }
  return path;
}

std::string lastOf(const std::string& path) {
  return path.substr(path.rfind('.') + 1);
}

/// The lines of a file down to the key.
std::string standing(const std::string& path) {
  std::string text, indent = "  ";
  bool in_list = false;
  const auto line = [&](const std::string& word) {
    text += indent + (in_list ? "- " : "") + word + ":\n";
    indent += in_list ? "    " : "  ";
    in_list = false;
  };
  for (std::size_t from = 0; from <= path.size();) {
    const auto dot = std::min(path.find('.', from), path.size());
    const std::string step = path.substr(from, dot - from);
    const bool list = step.ends_with("[]");
    line(list ? step.substr(0, step.size() - 2) : step);
    in_list = list;
    from = dot + 1;
  }
  text.insert(text.size() - 1, " ...");
  return text;
}

std::string page(const std::string& path, const Key& key, std::string_view of_file) {
  std::string text = fmt::format("{}, in {} files\n  {}\n", path, of_file, key.meaning);
  const auto line = [&](std::string_view name, const std::string& value) {
    if (!value.empty()) text += fmt::format("  {}: {}\n", name, value);
  };
  line("value", rules::expectation(key));
  line("unit", key.unit);
  line("range", rules::rangeText(key.limits));
  line("default", key.required ? "none: it must be there" : rules::written(key.default_value));
  line("Greene's name", key.greene);
  if (key.child) {
    std::string keys;
    for (const Key& inner : key.child->keys) keys += (keys.empty() ? "" : ", ") + inner.name;
    line("keys in it", keys);
  }
  return text + "  where it stands:\n" + standing(path);
}

}  // namespace

std::string explainKey(const std::string& name) {
  const std::string asked = spoken(name);
  std::vector<std::string> exact, last, greene;
  std::vector<std::string> names;
  for (const bool rules : {true, false}) {
    const std::string_view of_file = rules ? "rule" : "scene";
    forEachKey(rules ? rules::ruleTable() : sceneTable(), [&](const std::string& path, const Key& key) {
      const std::string said = spoken(path);
      names.push_back(said);
      if (!std::count(names.begin(), names.end(), lastOf(said))) names.push_back(lastOf(said));
      if (said == asked) {
        exact.push_back(page(path, key, of_file));
      } else if (said.ends_with("." + asked)) {
        last.push_back(page(path, key, of_file));
      } else if (key.greene == asked) {
        greene.push_back(page(path, key, of_file));
      }
    });
  }
  std::string text;
  for (const auto* const found : {&exact, &last, &greene}) {
    if (!text.empty()) break;
    for (const std::string& one : *found) text += (text.empty() ? "" : "\n") + one;
  }
  if (!text.empty()) return text;
  throw sim::InputError(
      fmt::format("espalier: no key of rule or scene files is called {}; expected a name such as "
                  "bias.up or world.voxel{}",
                  inQuotes(name), didYouMean(asked, names)));
}

}  // namespace espalier::scenes
