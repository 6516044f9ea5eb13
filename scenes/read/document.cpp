#include "scenes/read/document.h"

#include <fmt/format.h>

#include "scenes/clean_text.h"
#include "scenes/yaml/yaml_text.h"

namespace espalier::scenes {

std::filesystem::path beside(const YamlNode& node, std::string_view path) {
  return (std::filesystem::path(*node.place.path).parent_path() / path).lexically_normal();
}

std::string toldFrom(const std::filesystem::path& scene_file, const std::filesystem::path& file,
                     bool from_root) {
  const auto folder = std::filesystem::absolute(scene_file).lexically_normal().parent_path();
  const auto path = std::filesystem::absolute(file).lexically_normal().lexically_proximate(folder);
  const bool outside = path.is_absolute() || path.begin() == path.end() || *path.begin() == "..";
  return cleanText((from_root && outside ? file.filename() : path).generic_string());
}

std::optional<FileKind> headerOf(const YamlNode& root, Problems& problems) {
  const auto* header = root.entry("espalier");
  if (!header) {
    problems.add(
        root.place,
        fmt::format(
            "the file does not say what it is; expected 'espalier: rules' or 'espalier: scene' first{}",
            root.entries.empty() ? "" : didYouMean(root.entries.front().key, {"espalier"})));
    return std::nullopt;
  }
  const auto& value = header->value;
  if (value.refused) return std::nullopt;
  const auto slash = value.text.find('/');
  const auto kind = value.text.substr(0, slash);
  const auto version = slash == std::string::npos ? "1" : value.text.substr(slash + 1);
  if (kind != "rules" && kind != "scene") {
    problems.add(value.place, fmt::format("espalier is {}; expected rules or scene{}", described(value),
                                          didYouMean(kind, {"rules", "scene"})));
    return std::nullopt;
  }
  if (version != "1") {
    problems.add(value.place,
                 fmt::format("the version {} of the language; expected {}/1, the only one that there is",
                             inQuotes(version), kind));
    return std::nullopt;
  }
  return kind == "rules" ? FileKind::rules : FileKind::scene;
}

std::shared_ptr<const YamlNode> readDocument(const std::string& path, const Place& asker,
                                             std::optional<FileKind> expected, Problems& problems,
                                             std::uint64_t* hash) {
  const auto text = readText(path, asker, problems, hash);
  if (!text) return nullptr;
  auto root = parseYaml(*text, path, problems);
  if (!root) return nullptr;
  // A missing or damaged header is no reason not to read on.
  const auto kind = headerOf(*root, problems);
  if (!kind || !expected || *kind == *expected) return root;
  problems.add(root->entry("espalier")->value.place,
               *kind == FileKind::scene ? "this is a scene file; expected a rule file (espalier: rules)"
                                        : "this is a rule file; expected a scene file (espalier: scene)");
  return nullptr;
}

}  // namespace espalier::scenes
