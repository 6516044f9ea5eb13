#pragma once
#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <string>

#include "scenes/problem.h"
#include "scenes/yaml/yaml_tree.h"

/// Rule and scene files as such: what their first key says, and the paths in them.
namespace espalier::scenes {

/// What a file's first key says of it.
enum class FileKind { rules, scene };

/// A file as it was when it was read.
struct Document {
  std::shared_ptr<const YamlNode>
      root{};              ///< a mapping with a header; null where there is none to go on with
  std::uint64_t hash = 0;  ///< of all the file's bytes
};

/// Texts that are to become files, read in place of what these hold: by the path as canonicalOf has it.
using OpenTexts = std::map<std::string, std::string>;

/// One name for a file, however the way to it is written. There need be no file.
std::string canonicalOf(const std::filesystem::path& path);

/// Reads a file, or what is open in its place. `asker` is the place that names it; the file itself where
/// nothing does. Of a file without a header no word is repeated: it is not ours. Without `expected` any kind
/// will do.
Document readDocument(const std::string& path, const Place& asker, std::optional<FileKind> expected,
                      Problems& problems, const OpenTexts& open = {});
/// The same for a file that nothing names but who asks.
Document readDocument(const std::filesystem::path& path, std::optional<FileKind> expected, Problems& problems,
                      const OpenTexts& open = {});

/// The same for a text that was read already, or stands in no file; `path` is what messages call it.
Document documentOf(const std::string& text, const std::string& path, const Place& asker,
                    std::optional<FileKind> expected, Problems& problems);

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
