#pragma once
#include <string>
#include <utility>
#include <vector>

#include "rules/language/key.h"
#include "scenes/scene.h"

/// What was said, as a flat list of paths and values: for comparing the inputs of two runs.
namespace espalier::scenes {

using Settings = std::vector<std::pair<std::string, std::string>>;

/// Every key of the struct that a table describes, defaults included, in the order of the table: its path
/// ("plants[0].rules.bias.up", "cameras.main.fov") and its value as a file would have it. Values that differ
/// never look alike; a value that is not there is empty. A rule set's own file and those that it builds on
/// are not told: what they say is. Where one rule set (a file's) comes to bear twice within another, the
/// second place says "as " and the first one's path from the outermost rule set.
Settings settings(const rules::Table& table, const void* object);

/// Of a rule set, and of a scene, where the paths of meshes are from the scene's file.
Settings settings(const rules::RuleSet& rules);
Settings settings(const Scene& scene);

/// One line each, "path: value".
std::string format(const Settings& settings);

}  // namespace espalier::scenes
