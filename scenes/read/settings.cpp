#include "scenes/read/settings.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>

#include "rules/language/colour.h"
#include "rules/language/registry.h"
#include "scenes/read/registry.h"

namespace espalier::scenes {
namespace {

using rules::Key;
using rules::Kind;
using rules::RuleSet;
using rules::Table;

/// A word as it is; any other text in quotes, so that its end is seen.
std::string inWords(const std::string& text) {
  constexpr std::string_view kPlain = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-";
  if (!text.empty() && text.find_first_not_of(kPlain) == text.npos) return text;
  return nlohmann::json(text).dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

/// "#rrggbb" where that is the very colour, or else its three numbers.
std::string inWords(const sim::Colour& colour) {
  const auto hex = rules::hexFromLinear(colour);
  const auto channel = [&](std::size_t at) {
    return static_cast<float>(std::stoi(hex.substr(at, 2), nullptr, 16)) / 255.0f;
  };
  if (rules::linearFromSrgb({channel(1), channel(3), channel(5)}) == colour) return hex;
  return fmt::format("[{}, {}, {}] linear", colour.r, colour.g, colour.b);
}

std::string inWords(const rules::Datum& datum) {
  if (const auto* text = std::get_if<std::string>(&datum)) return text->empty() ? "" : inWords(*text);
  if (const auto* colour = std::get_if<sim::Colour>(&datum)) return inWords(*colour);
  if (const auto* names = std::get_if<std::vector<std::string>>(&datum)) {
    std::string all;
    for (const auto& name : *names) all += (all.empty() ? "" : ", ") + inWords(name);
    return "[" + all + "]";
  }
  return rules::written(datum);
}

class Lister {
 public:
  explicit Lister(Settings& settings) : settings_(settings) {}

  void list(const Table& table, const void* object, const std::string& prefix) {
    for (const auto& key : table.keys) listKey(key, object, prefix + key.name);
  }

  /// A rule set that stands in no other.
  void listRules(const RuleSet& rules, const std::string& path) {
    first_.clear();
    outermost_ = path.empty() ? 0 : path.size() + 1;
    listWithin(rules, path);
  }

 private:
  void say(const std::string& path, std::string value) { settings_.emplace_back(path, std::move(value)); }

  void listKey(const Key& key, const void* object, const std::string& path) {
    switch (key.kind) {
      case Kind::header:
      case Kind::base:
        return;  // how a file is made up, not what it says
      case Kind::section:
        if (const void* inner = key.look(object)) return list(*key.child, inner, path + ".");
        return say(path, "");
      case Kind::entries:
      case Kind::named:
        return listItems(key, object, path);
      case Kind::rules:
        return listReference(std::get<rules::RuleReference>(orNone(key.get(object))).rules.get(), path);
      case Kind::regions:
        return listRegions(*static_cast<const RuleSet*>(object), path);
      default:
        return say(path, inWords(key.get(object)));
    }
  }

  static rules::Datum orNone(rules::Datum datum) {
    return std::holds_alternative<std::monostate>(datum) ? rules::RuleReference{} : std::move(datum);
  }

  void listItems(const Key& key, const void* object, const std::string& path) {
    const auto items = key.items(object);
    if (items.empty()) say(path, key.kind == Kind::named ? "{}" : "[]");
    for (std::size_t i = 0; i < items.size(); ++i) {
      const auto step = key.kind == Kind::named ? "." + inWords(items[i].name) : fmt::format("[{}]", i);
      list(*key.child, items[i].object, path + step + ".");
    }
  }

  void listReference(const RuleSet* rules, const std::string& path) {
    if (!rules) return say(path, "");
    if (depth_ == 0) return listRules(*rules, path);
    listWithin(*rules, path);
  }

  void listWithin(const RuleSet& rules, const std::string& path) {
    const auto [first, is_new] = first_.try_emplace(&rules, path);
    if (!is_new) {
      return say(path, "as " + first->second.substr(outermost_));
    }
    ++depth_;
    list(rules::ruleTable(), &rules, path.empty() ? "" : path + ".");
    --depth_;
  }

  void listRegions(const RuleSet& rules, const std::string& path) {
    if (rules.regions.empty() && !rules.others) say(path, "{}");
    for (const auto& [region, rule] : rules.regions) listRegion(rule, path + "." + inWords(region));
    if (rules.others) listRegion(*rules.others, path + "." + rules::kOthers);
  }

  void listRegion(const rules::RegionRule& rule, const std::string& path) {
    if (rule.forbidden) return say(path, "forbid");
    if (!rule.rules) return say(path, "{}");
    listReference(rule.rules.get(), path);
  }

  Settings& settings_;
  std::map<const RuleSet*, std::string> first_;  ///< of the outermost rule set: where each was listed
  std::size_t outermost_ = 0;                    ///< bytes of a path up to within it
  int depth_ = 0;
};

}  // namespace

Settings settings(const Table& table, const void* object) {
  Settings all;
  Lister lister(all);
  if (&table == &rules::ruleTable()) {
    lister.listRules(*static_cast<const RuleSet*>(object), "");
  } else {
    lister.list(table, object, "");
  }
  return all;
}

Settings settings(const RuleSet& rules) {
  return settings(rules::ruleTable(), &rules);
}

Settings settings(const Scene& scene) {
  Scene beside = scene;
  const auto folder = scene.file.parent_path().lexically_normal();
  const auto place = [&](std::filesystem::path& file) {
    if (!file.empty()) file = file.lexically_normal().lexically_proximate(folder).generic_string();
  };
  for (auto& mesh : beside.meshes) {
    place(mesh.file);
    place(mesh.from);
  }
  forEachTable(beside, [&](PointTable& table, const std::string&) { place(table.file); });
  for (auto& field : beside.fields) place(field.file);
  for (auto& attractors : beside.attractors) {
    if (!attractors.picture) continue;
    place(attractors.picture->file);
    place(attractors.picture->from);
  }
  place(beside.sky.background.file);
  for (auto& plant : beside.plants) {
    if (!plant.skeleton) continue;
    place(plant.skeleton->file);
    place(plant.skeleton->from);
  }
  return settings(sceneTable(), &beside);
}

std::string format(const Settings& settings) {
  std::string all;
  for (const auto& [path, value] : settings) all += fmt::format("{}: {}\n", path, value);
  return all;
}

}  // namespace espalier::scenes
