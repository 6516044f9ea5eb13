#pragma once
#include <filesystem>
#include <optional>
#include <string>

#include "scenes/problem.h"
#include "scenes/scene.h"

namespace espalier::scenes {

/// Reads a scene file and the rule files that it names: a scene, or every problem in all of those files.
/// Meshes are not read, but one that is missing (and not optional) is a problem here. Names that were left
/// out are filled in.
Result<Scene> readScene(const std::filesystem::path& path);

/// The same for a text that is to become the file `path`.
Result<Scene> readSceneText(const std::string& text, const std::filesystem::path& path);

/// Reads a rule or scene file, whichever its first key says that it is, and the files that it names, each
/// once: a scene, nothing for rules, or every problem in all of those files.
Result<std::optional<Scene>> readRulesOrScene(const std::filesystem::path& path);

}  // namespace espalier::scenes
