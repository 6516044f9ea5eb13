#include "scenes/read/document.h"

#include <fmt/format.h>

#include <algorithm>
#include <string_view>
#include <system_error>
#include <utility>

#include "scenes/clean_text.h"
#include "scenes/yaml/yaml_text.h"
#include "sim/base/hasher.h"

namespace espalier::scenes {
namespace {

constexpr std::string_view kHeader = "espalier";

/// Whether "espalier:" comes first, in quotes or not.
bool isHeader(std::string_view text) {
  constexpr std::string_view kSpace = " \t\r";
  const auto skip = [&](std::string_view characters) {
    text.remove_prefix(std::min(text.find_first_not_of(characters), text.size()));
  };
  skip(" \t\"'");
  if (!text.starts_with(kHeader)) return false;
  text.remove_prefix(kHeader.size());
  skip(" \t\"'");
  return text == ":" || (text.starts_with(':') && kSpace.find(text[1]) != kSpace.npos);
}

/// What a text says that it is, before anything in it is repeated: a file that is not ours may hold what
/// nobody else should read.
struct FirstLook {
  bool ours = false;        ///< "espalier:" begins one of the lines that stand as far left as the first
  std::string_view line{};  ///< the first one that says something
};

FirstLook lookAt(std::string_view text) {
  FirstLook look;
  std::size_t first_indent = 0;
  while (!text.empty() && !look.ours) {
    const auto end = std::min(text.find('\n'), text.size());
    auto line = text.substr(0, end);
    text.remove_prefix(std::min(end + 1, text.size()));
    const auto indent = std::min(line.find_first_not_of(" \t\r"), line.size());
    line.remove_prefix(indent);
    if (line.empty() || line.front() == '#' || line.starts_with("---")) continue;
    if (look.line.empty()) {
      look.line = line;
      first_indent = indent;
    }
    look.ours = indent == first_indent && isHeader(line);
    if (look.line.front() != '{') continue;  // in braces keys stand anywhere
    for (auto at = line.find_first_of("{,"); at != line.npos && !look.ours;
         at = line.find_first_of("{,", at + 1))
      look.ours = isHeader(line.substr(at + 1));
    look.ours = look.ours || isHeader(line);
  }
  return look;
}

/// Says so where the file is asked for; of the file itself no more than that it may have misspelt its header.
void refuseAsForeign(const std::string& path, const Place& asker, std::string_view first_line,
                     Problems& problems) {
  constexpr std::string_view kExpected = "expected 'espalier: rules' or 'espalier: scene' first";
  const bool asks_itself = *asker.path == path;
  problems.add(
      asks_itself ? Place{asker.path, 1, 1} : asker,
      fmt::format("{}{}; {}{}", asks_itself ? "" : path + ": ",
                  first_line.empty() ? "an empty file" : "the file does not say what it is", kExpected,
                  didYouMean(first_line.substr(0, first_line.find(':')), {std::string(kHeader)})));
}

}  // namespace

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
  const auto& value = root.entry(kHeader)->value;
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

std::string canonicalOf(const std::filesystem::path& path) {
  std::error_code error;
  const std::filesystem::path canonical = std::filesystem::weakly_canonical(path, error);
  return error ? path.string() : canonical.string();
}

Document readDocument(const std::string& path, const Place& asker, std::optional<FileKind> expected,
                      Problems& problems, const OpenTexts& open) {
  if (const auto written = open.empty() ? open.end() : open.find(canonicalOf(path)); written != open.end())
    return documentOf(written->second, path, asker, expected, problems);
  std::uint64_t hash = 0;
  const auto text = readText(path, asker, problems, &hash);
  if (!text) return {};
  Document document = documentOf(*text, path, asker, expected, problems);
  document.hash = hash;  // of the bytes, with a byte order mark
  return document;
}

Document documentOf(const std::string& text, const std::string& path, const Place& asker,
                    std::optional<FileKind> expected, Problems& problems) {
  const auto look = lookAt(text);
  const auto root = look.ours ? parseYaml(text, path, problems) : nullptr;
  if (look.ours && !root) return {};
  if (!root || !root->entry(kHeader)) {
    refuseAsForeign(path, asker, look.line, problems);
    return {};
  }
  // A damaged header is no reason not to read on.
  const auto kind = headerOf(*root, problems);
  if (!kind || !expected || *kind == *expected) return {root, sim::hashOf(text)};
  problems.add(root->entry("espalier")->value.place,
               *kind == FileKind::scene ? "this is a scene file; expected a rule file (espalier: rules)"
                                        : "this is a rule file; expected a scene file (espalier: scene)");
  return {};
}

Document readDocument(const std::filesystem::path& path, std::optional<FileKind> expected, Problems& problems,
                      const OpenTexts& open) {
  return readDocument(path.string(), {std::make_shared<const std::string>(path.string()), 0, 0}, expected,
                      problems, open);
}

}  // namespace espalier::scenes
