#pragma once
#include <span>
#include <string_view>

namespace espalier::scenes {

/// A file of scenes/first_project, which is a part of the program.
struct FirstProjectFile {
  std::string_view name;  ///< from the project's folder
  std::string_view text;
};

std::span<const FirstProjectFile> firstProjectFiles();

}  // namespace espalier::scenes
