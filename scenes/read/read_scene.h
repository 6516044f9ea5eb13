#pragma once
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "scenes/problem.h"
#include "scenes/read/document.h"
#include "scenes/scene.h"

namespace espalier::scenes {

/// Reads a scene file and the rule files that it names: a scene, or every problem in all of those files.
/// Meshes are not read, but one that is missing (and not optional) is a problem here. Names that were left
/// out are filled in.
/// What is open is read in place of files, those of other scenes too.
Result<Scene> readScene(const std::filesystem::path& path, const OpenTexts& open = {});

/// The same for a text that is to become the file `path`.
Result<Scene> readSceneText(const std::string& text, const std::filesystem::path& path);

/// The scene file and the rule files that it names, so far as they can be read, whatever is wrong with them:
/// a scene's read_files and read_paths, and nothing else of it.
Scene filesOfScene(const std::filesystem::path& path, const OpenTexts& open = {});

struct RulesOrScene {
  std::optional<Scene> scene;     ///< without one they are rules
  std::vector<Problem> warnings;  ///< what its files say without effect
};

/// Reads a rule or scene file, whichever its first key says that it is, and the files that it names, each
/// once: or every problem in all of those files.
Result<RulesOrScene> readRulesOrScene(const std::filesystem::path& path);

/// The same for a text that is to become the file `path`.
Result<RulesOrScene> readRulesOrSceneText(std::string text, const std::filesystem::path& path);

}  // namespace espalier::scenes
