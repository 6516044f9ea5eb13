#include "scenes/read/rule_library.h"

#include <algorithm>

namespace espalier::scenes {
namespace {

constexpr std::string_view kPrefix = "library:";

}  // namespace

const LibraryRules* libraryRules(std::string_view name) {
  const auto all = ruleLibrary();
  const auto at = std::find_if(all.begin(), all.end(), [&](const LibraryRules& r) { return r.name == name; });
  return at == all.end() ? nullptr : &*at;
}

std::vector<std::string> libraryNames() {
  std::vector<std::string> names;
  for (const LibraryRules& rules : ruleLibrary()) names.emplace_back(rules.name);
  return names;
}

std::string aboutOf(const LibraryRules& rules) {
  std::string about;
  for (std::string_view rest = rules.text; rest.starts_with('#');) {
    const auto end = std::min(rest.find('\n'), rest.size());
    std::string_view line = rest.substr(1, end - 1);
    rest.remove_prefix(std::min(end + 1, rest.size()));
    line.remove_prefix(std::min(line.find_first_not_of(' '), line.size()));
    about += (about.empty() ? "" : " ") + std::string(line);
  }
  const auto stop = about.find(". ");
  return stop == about.npos ? about : about.substr(0, stop + 1);
}

std::string libraryPath(std::string_view name) {
  return std::string(kPrefix) + std::string(name);
}

std::string_view nameInLibrary(std::string_view path) {
  return isLibraryPath(path) ? path.substr(kPrefix.size()) : std::string_view();
}

bool isLibraryPath(std::string_view path) {
  return path.starts_with(kPrefix);
}

}  // namespace espalier::scenes
