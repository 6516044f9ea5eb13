#pragma once
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>

#include "scenes/problem.h"
#include "scenes/yaml/yaml_tree.h"

/// Rule and scene files as such: what their first key says, and the paths in them.
namespace espalier::scenes {

/// What a file's first key says of it.
enum class FileKind { rules, scene };

/// A file's root mapping, with a header, or null. `asker` is the place that names the file; the file itself
/// where nothing does. Of a file without a header no word is repeated: it is not ours. Without `expected` any
/// kind will do. `hash` is of all the file's bytes.
std::shared_ptr<const YamlNode> readDocument(const std::string& path, const Place& asker,
                                             std::optional<FileKind> expected, Problems& problems,
                                             std::uint64_t* hash = nullptr);

/// The kind that a root's header, which must be there, names, or nothing after a problem was reported.
std::optional<FileKind> headerOf(const YamlNode& root, Problems& problems);

/// A path as it stands in the file of `node`, from where that file lies.
std::filesystem::path beside(const YamlNode& node, std::string_view path);

/// What reports call a file: its path from the scene's file. One that the scene places from the machine's
/// root, and not in the scene's own folder, is called by its last name alone, so that nothing of the machine
/// is told.
std::string toldFrom(const std::filesystem::path& scene_file, const std::filesystem::path& file,
                     bool from_root);

}  // namespace espalier::scenes
