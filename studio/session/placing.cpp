#include "studio/session/placing.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string_view>

#include "scenes/clean_text.h"
#include "scenes/problem.h"
#include "scenes/yaml/yaml_tree.h"
#include "sim/base/error.h"
#include "studio/wire/json.h"

namespace espalier::studio {
namespace {

using scenes::YamlNode;

std::shared_ptr<const YamlNode> rootOf(const std::string& text) {
  scenes::Problems problems;
  auto root = scenes::parseYaml(text, "scene", problems);
  if (!root) throw sim::InputError("the scene's text cannot be read as it is");
  return root;
}

/// In millimetres: finer than anybody points.
std::string number(double metres) {
  const double rounded = std::round(metres * 1000.0) / 1000.0;
  return fmt::format("{}", rounded == 0.0 ? 0.0 : rounded);
}

std::string list(sim::Vec3 p_m) {
  return fmt::format("[{}, {}, {}]", number(p_m.x), number(p_m.y), number(p_m.z));
}

std::vector<std::string> linesOf(const std::string& text) {
  std::vector<std::string> lines;
  for (std::size_t at = 0; at <= text.size();) {
    const std::size_t end = std::min(text.find('\n', at), text.size());
    lines.push_back(text.substr(at, end - at));
    at = end + 1;
  }
  return lines;
}

std::size_t charactersIn(std::string_view text) {
  return static_cast<std::size_t>(
      std::count_if(text.begin(), text.end(), [](char c) { return (c & 0xc0) != 0x80; }));
}

/// Each number of a place where it stands.
void moveNumbers(const YamlNode& place, sim::Vec3 to_m, std::vector<TextEdit>& edits) {
  if (place.kind != YamlNode::Kind::list || place.items.size() != 3)
    throw sim::InputError("the place is not written as three numbers");
  for (int axis = 0; axis < 3; ++axis) {
    const scenes::Place& at = place.items[static_cast<std::size_t>(axis)].place;
    if (at.line == 0 || at.end_column <= at.column)
      throw sim::InputError("the place is not written as three numbers");
    edits.push_back({{at.line, at.column}, {at.line, at.end_column}, number(to_m[axis])});
  }
}

int lastLine(const YamlNode& node) {
  int line = node.place.line;
  for (const YamlNode& item : node.items) line = std::max(line, lastLine(item));
  for (const scenes::YamlEntry& entry : node.entries)
    line = std::max({line, entry.place.line, lastLine(entry.value)});
  return line;
}

/// Behind the end of that line.
TextEdit::At endOf(const std::vector<std::string>& lines, int line) {
  return {line, static_cast<int>(charactersIn(lines.at(static_cast<std::size_t>(line - 1)))) + 1};
}

/// Whether a node begins its line but for spaces and the dash or key before it: in brackets it does not.
bool inBrackets(const std::vector<std::string>& lines, const scenes::Place& first) {
  const std::string& line = lines.at(static_cast<std::size_t>(first.line - 1));
  std::size_t characters = 0;
  for (std::size_t byte = 0; byte < line.size(); ++byte) {
    if ((line[byte] & 0xc0) != 0x80 && ++characters >= static_cast<std::size_t>(first.column)) break;
    if (line[byte] == '[' || line[byte] == '{' || line[byte] == ',') return true;
  }
  return false;
}

/// Behind the bracket that closes what begins at a place.
TextEdit::At behindBracket(const std::vector<std::string>& lines, const scenes::Place& from) {
  int depth = 0;
  char quote = 0;
  for (std::size_t l = static_cast<std::size_t>(from.line - 1); l < lines.size(); ++l) {
    int column = 0;
    for (std::size_t byte = 0; byte < lines[l].size(); ++byte) {
      const char c = lines[l][byte];
      if ((c & 0xc0) != 0x80) ++column;
      if (l == static_cast<std::size_t>(from.line - 1) && column < from.column) continue;
      if (quote != 0) {
        if (c == quote) quote = 0;
      } else if (c == '"' || c == '\'') {
        quote = c;
      } else if (c == '#' && byte > 0 && lines[l][byte - 1] == ' ') {
        break;
      } else if (c == '[' || c == '{') {
        ++depth;
      } else if ((c == ']' || c == '}') && --depth == 0) {
        return {static_cast<int>(l) + 1, column + 1};
      }
    }
  }
  throw sim::InputError("a bracket is not closed");
}

const YamlNode& plantNode(const YamlNode& root, const scenes::Scene& scene, const std::string& planting) {
  const auto at = std::find_if(scene.plants.begin(), scene.plants.end(),
                               [&](const scenes::PlantSpec& plant) { return plant.name == planting; });
  if (at == scene.plants.end()) throw sim::InputError("no planting is called " + scenes::inQuotes(planting));
  const auto* const plants = root.entry("plants");
  const auto index = static_cast<std::size_t>(at - scene.plants.begin());
  if (!plants || index >= plants->value.items.size())
    throw sim::InputError("the text has no planting " + scenes::inQuotes(planting));
  return plants->value.items[index];
}

const YamlNode& seedsNode(const YamlNode& plant) {
  const auto* const seeds = plant.entry("seeds");
  if (!seeds || seeds->value.kind != YamlNode::Kind::list || seeds->value.items.empty())
    throw sim::InputError("the planting's seeds are not written one by one; expected seeds: [[x, y, z]]");
  return seeds->value;
}

bool isName(const std::string& name) {
  constexpr std::string_view kAllowed = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-";
  return !name.empty() && name.size() <= 40 && name.find_first_not_of(kAllowed) == std::string::npos;
}

}  // namespace

std::vector<TextEdit> seedMoved(const std::string& text, const scenes::Scene& scene,
                                const std::string& planting, std::size_t seed, sim::Vec3 to_m) {
  const auto root = rootOf(text);
  const YamlNode& seeds = seedsNode(plantNode(*root, scene, planting));
  if (seed >= seeds.items.size()) throw sim::InputError("the text does not say where that seed is");
  const YamlNode& node = seeds.items[seed];
  const auto* const at = node.entry("at");
  std::vector<TextEdit> edits;
  moveNumbers(at ? at->value : node, to_m, edits);
  return edits;
}

std::vector<TextEdit> seedAdded(const std::string& text, const scenes::Scene& scene,
                                const std::string& planting, sim::Vec3 at_m) {
  const auto root = rootOf(text);
  const YamlNode& last = seedsNode(plantNode(*root, scene, planting)).items.back();
  const std::vector<std::string> lines = linesOf(text);
  if (inBrackets(lines, last.place)) {
    const TextEdit::At behind = behindBracket(lines, last.place);
    return {{behind, behind, ", " + list(at_m)}};
  }
  const std::string& line = lines.at(static_cast<std::size_t>(last.place.line - 1));
  const std::string indent = line.substr(0, line.find_first_not_of(' '));
  const TextEdit::At end = endOf(lines, lastLine(last));
  return {{end, end, "\n" + indent + "- " + list(at_m)}};
}

std::vector<TextEdit> cameraSet(const std::string& text, const std::string& name, sim::Vec3 eye_m,
                                sim::Vec3 target_m) {
  if (!isName(name))
    throw sim::InputError(scenes::inQuotes(name) + " is no name for a camera; expected letters and digits");
  const auto root = rootOf(text);
  const std::vector<std::string> lines = linesOf(text);
  const std::string camera = fmt::format("{}: {{eye: {}, target: {}}}", name, list(eye_m), list(target_m));
  const auto* const cameras = root->entry("cameras");
  if (!cameras || cameras->value.entries.empty()) {
    const TextEdit::At end = endOf(lines, static_cast<int>(lines.size()));
    return {{end, end, (lines.back().empty() ? "" : "\n") + ("cameras:\n  " + camera + "\n")}};
  }
  if (const auto* const known = cameras->value.entry(name)) {
    const auto* const eye = known->value.entry("eye");
    const auto* const target = known->value.entry("target");
    if (!eye || !target)
      throw sim::InputError("the camera " + scenes::inQuotes(name) + " has no eye and target in the text");
    std::vector<TextEdit> edits;
    moveNumbers(eye->value, eye_m, edits);
    moveNumbers(target->value, target_m, edits);
    return edits;
  }
  const scenes::YamlEntry& last = cameras->value.entries.back();
  if (inBrackets(lines, last.place)) {
    const TextEdit::At behind = behindBracket(lines, last.value.place);
    return {{behind, behind, ", " + camera}};
  }
  const TextEdit::At end = endOf(lines, lastLine(last.value));
  return {{end, end, "\n" + std::string(static_cast<std::size_t>(last.place.column - 1), ' ') + camera}};
}

std::string changeJson(const std::string& file, const std::vector<TextEdit>& edits) {
  const auto at = [](const TextEdit::At& place) {
    return Json{{"line", place.line}, {"column", place.column}};
  };
  Json list = Json::array();
  for (const TextEdit& edit : edits)
    list.push_back({{"from", at(edit.from)}, {"to", at(edit.to)}, {"insert", edit.insert}});
  return textOf({{"file", file}, {"edits", std::move(list)}});
}

}  // namespace espalier::studio
