#pragma once
#include <filesystem>
#include <vector>

#include "scenes/problem.h"
#include "scenes/scene.h"

namespace espalier::scenes {

/// Reads a scene file and the rule files that it names: a scene, or every problem in all of those files.
/// Meshes are not read, but one that is missing (and not optional) is a problem here. Names that were left
/// out are filled in.
Result<Scene> readScene(const std::filesystem::path& path);

/// Every problem of a rule or scene file and of the files that it names; its first key says which it is.
std::vector<Problem> checkFile(const std::filesystem::path& path);

/// Whether a file's first key says that it is a scene.
bool isScene(const std::filesystem::path& path);

}  // namespace espalier::scenes
