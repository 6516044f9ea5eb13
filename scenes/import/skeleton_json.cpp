#include <fmt/format.h>

#include <limits>
#include <nlohmann/json.hpp>
#include <optional>

#include "scenes/clean_text.h"
#include "scenes/import/skeleton_reader.h"
#include "scenes/problem.h"
#include "sim/base/counted.h"
#include "sim/base/error.h"

namespace espalier::scenes {
namespace {

using Json = nlohmann::json;

/// A JSON pointer, written out where something is wrong there.
struct Pointer {
  std::string_view list;
  std::optional<std::size_t> entry = std::nullopt;
  std::string_view key = {};

  std::string text() const {
    std::string all(list);
    if (entry) all += fmt::format("/{}", *entry);
    if (!key.empty()) all += fmt::format("/{}", key);
    return all.empty() ? "/" : all;
  }
};

[[noreturn]] void failAt(const Pointer& pointer, const std::string& what) {
  throw sim::InputError(fmt::format("{}: {}", pointer.text(), what));
}

std::string kindOf(const Json& value) {
  if (value.is_string()) return inQuotes(value.get_ref<const std::string&>());
  return value.is_primitive() ? value.dump() : fmt::format("an {}", value.type_name());
}

Json parsed(std::string_view text) {
  try {
    return Json::parse(text);  // by a stack of its own, however deep lists lie in each other
  } catch (const Json::exception& error) {
    throw sim::InputError(fmt::format("this is no JSON: {}", cleanText(error.what())));
  }
}

double numberIn(const Json& value, const Pointer& pointer) {
  if (!value.is_number()) failAt(pointer, fmt::format("{} is no number; expected one", kindOf(value)));
  return value.get<double>();
}

sim::Vec3 placeIn(const Json& value, const Pointer& pointer) {
  if (!value.is_array() || value.size() != 3)
    failAt(pointer, fmt::format("{} is no place; expected [x, y, z]", kindOf(value)));
  sim::Vec3 place;
  for (int axis = 0; axis < 3; ++axis) place[axis] = numberIn(value[static_cast<std::size_t>(axis)], pointer);
  requirePlace(place, [&] { return pointer.text() + ": the node"; });
  return place;
}

float radiusIn(const Json& value, const Pointer& pointer) {
  return soundRadius(numberIn(value, pointer), [&] { return pointer.text() + ": the node"; });
}

std::int32_t parentIn(const Json& value, const Pointer& pointer) {
  if (value.is_null()) return -1;
  constexpr std::int64_t kMost = std::numeric_limits<std::int32_t>::max();
  if (value.is_number_integer()) {
    const bool beyond =
        value.is_number_unsigned() && value.get<std::uint64_t>() > static_cast<std::uint64_t>(kMost);
    const std::int64_t parent = beyond ? kMost : value.get<std::int64_t>();
    if (parent < -1)
      failAt(pointer, fmt::format("the parent is {}; expected the number of a node, or -1", parent));
    return static_cast<std::int32_t>(parent);
  }
  failAt(pointer, fmt::format("the parent is {}; expected the number of a node, or -1", kindOf(value)));
}

void requireFew(std::size_t nodes, const Pointer& pointer) {
  if (nodes > kMostSkeletonNodes)
    failAt(pointer, fmt::format("there are {} nodes; expected at most {}", nodes, kMostSkeletonNodes));
}

const Json& listAt(const Json& object, const char* key, std::string_view pointer) {
  const auto at = object.find(key);
  if (at == object.end())
    failAt({pointer}, fmt::format("it has no {}; expected a list of that name", inQuotes(key)));
  if (!at->is_array()) failAt({pointer, {}, key}, fmt::format("{} is no list; expected one", kindOf(*at)));
  return *at;
}

constexpr float kNoRadius = 1.0f;  // of a root, in which no segment ends

/// {"parent": 0, "position": [x, y, z], "radius": 0.1}, one after another.
Forest plainForest(const Json& nodes, std::string_view pointer) {
  requireFew(nodes.size(), {pointer});
  Forest forest;
  std::optional<bool> have_radii;
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    const Json& node = nodes[i];
    if (!node.is_object())
      failAt({pointer, i},
             fmt::format("{} is no node; expected {{\"parent\": 0, \"position\": [x, y, z]}}", kindOf(node)));
    const auto position = node.find("position"), parent = node.find("parent"), radius = node.find("radius");
    if (position == node.end()) failAt({pointer, i}, "the node has no position; expected one, [x, y, z]");
    forest.position.push_back(placeIn(*position, {pointer, i, "position"}));
    forest.parent.push_back(parent == node.end() ? -1 : parentIn(*parent, {pointer, i, "parent"}));
    const bool has = radius != node.end();
    const float own = has ? radiusIn(*radius, {pointer, i, "radius"}) : kNoRadius;
    forest.radius.push_back(kNoRadius);
    if (forest.parent.back() < 0) continue;  // it ends no segment
    if (has != have_radii.value_or(has))
      failAt({pointer, i},
             fmt::format("the node has {} radius, unlike those before it; expected one for each, or none",
                         has ? "a" : "no"));
    have_radii = has;
    forest.radius.back() = own;
  }
  if (!have_radii.value_or(false)) forest.radius.clear();
  return forest;
}

/// A plant of our own: columns.
Forest plantForest(const Json& plant, const std::string& pointer) {
  if (!plant.is_object()) failAt({pointer}, fmt::format("{} is no plant; expected an object", kindOf(plant)));
  Forest forest;
  if (const auto name = plant.find("name"); name != plant.end() && name->is_string())
    forest.name = cleanText(name->get_ref<const std::string&>());
  const Json &parents = listAt(plant, "parent", pointer), &positions = listAt(plant, "position_m", pointer);
  requireFew(parents.size(), {pointer, {}, "parent"});
  const auto requireAsMany = [&](const Json& list, const char* key) {
    if (list.size() != parents.size())
      failAt({pointer, {}, key},
             fmt::format("{} for {}; expected one for each", sim::counted(list.size(), "entry", "entries"),
                         sim::counted(parents.size(), "node")));
  };
  requireAsMany(positions, "position_m");
  const std::string parent_at = pointer + "/parent", position_at = pointer + "/position_m",
                    radius_at = pointer + "/radius_m";
  for (std::size_t i = 0; i < parents.size(); ++i) {
    forest.parent.push_back(parentIn(parents[i], {parent_at, i}));
    forest.position.push_back(placeIn(positions[i], {position_at, i}));
  }
  if (!plant.contains("radius_m")) return forest;
  const Json& radii = listAt(plant, "radius_m", pointer);
  requireAsMany(radii, "radius_m");
  for (std::size_t i = 0; i < radii.size(); ++i)
    forest.radius.push_back(forest.parent[i] < 0 ? kNoRadius : radiusIn(radii[i], {radius_at, i}));
  return forest;
}

void requireVersion(const Json& file) {
  const auto version = file.find("espalier");
  if (version != file.end() && *version != "skeleton/1" && *version != "skeleton")
    failAt({"", {}, "espalier"}, fmt::format("{} is not known; expected \"skeleton/1\"", kindOf(*version)));
}

struct PlacedForest {
  Forest forest;
  std::string pointer;
};

std::vector<PlacedForest> forestsIn(const Json& file) {
  if (file.is_array()) return {{plainForest(file, ""), "/"}};
  if (!file.is_object())
    failAt({""}, fmt::format("{} is no skeleton; expected an object with plants or nodes, or a list of nodes",
                             kindOf(file)));
  requireVersion(file);
  if (!file.contains("plants")) return {{plainForest(listAt(file, "nodes", ""), "/nodes"), "/nodes"}};
  const Json& plants = listAt(file, "plants", "");
  std::vector<PlacedForest> forests;
  std::size_t nodes = 0;
  for (std::size_t i = 0; i < plants.size(); ++i) {
    const std::string pointer = fmt::format("/plants/{}", i);
    forests.push_back({plantForest(plants[i], pointer), pointer});
    nodes += forests.back().forest.parent.size();
    requireFew(nodes, {pointer});
  }
  return forests;
}

}  // namespace

std::vector<FileTree> skeletonsInJson(std::string_view text) {
  // What was parsed is several times as large as what it says.
  const std::vector<PlacedForest> forests = forestsIn(parsed(text));
  std::vector<FileTree> trees;
  for (const auto& [forest, pointer] : forests) {
    for (FileTree& tree : treesOf(
             forest, [&at = pointer](std::size_t node) { return fmt::format("{}: node {}", at, node); })) {
      if (!trees.empty() && tree.radius.empty() != trees.front().radius.empty())
        failAt({pointer},
               fmt::format("the plant has {} radii, unlike those before it; expected some for each, or none",
                           tree.radius.empty() ? "no" : "its"));
      trees.push_back(std::move(tree));
    }
  }
  return trees;
}

}  // namespace espalier::scenes
