#pragma once
#include <span>
#include <string>
#include <string_view>
#include <vector>

/// The rule sets of rules/library, which are a part of the program: known by name wherever it was put.
namespace espalier::scenes {

struct LibraryRules {
  std::string_view name;  ///< of its file, without an ending
  std::string_view text;  ///< the file
};

/// In the order of their names.
std::span<const LibraryRules> ruleLibrary();
/// Null where none has the name.
const LibraryRules* libraryRules(std::string_view name);
std::vector<std::string> libraryNames();

/// The first sentence of the words above its keys.
std::string aboutOf(const LibraryRules& rules);

/// What messages and reports call the file of one: "library:ivy".
std::string libraryPath(std::string_view name);
/// The name in such a path; empty where it is another one.
std::string_view nameInLibrary(std::string_view path);
bool isLibraryPath(std::string_view path);

}  // namespace espalier::scenes
