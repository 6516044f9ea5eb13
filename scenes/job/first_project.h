#pragma once
#include <filesystem>
#include <string>
#include <vector>

namespace espalier::scenes {

/// Makes a first project in a folder that is empty or not there: a scene of a mesh of its own, rules for it,
/// the JSON Schemas of both and the settings by which editors find them; the names of its files, in order.
/// Throws sim::InputError, and then nothing is left of it.
std::vector<std::string> makeFirstProject(const std::filesystem::path& folder);

}  // namespace espalier::scenes
