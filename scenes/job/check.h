#pragma once
#include <filesystem>
#include <optional>
#include <stop_token>
#include <string>
#include <vector>

#include "scenes/foretell/foretell.h"
#include "scenes/problem.h"

/// What is wrong with rule and scene files, found without doing what they ask for.
namespace espalier::scenes {

/// How much of a scene is looked at.
enum class CheckDepth {
  text,  ///< its file and the rule files that it names: no mesh is opened
  site   ///< its meshes too, and the world of them, to where plants would grow or light would be looked for
};

struct Checked {
  std::filesystem::path file;
  std::vector<Problem> errors;       ///< all that grow and expose would name before they begin
  std::vector<Problem> warnings;     ///< that they would tell of
  std::optional<Foretold> foretold;  ///< of a scene without errors, with its site: to grow its plants, or
                                     ///< else to find its light
};

/// Of a rule or scene file. Throws sim::Stopped.
Checked checkFile(const std::filesystem::path& file, CheckDepth depth, std::stop_token stop = {});

/// The same for a text that is to become the file.
Checked checkText(std::string text, const std::filesystem::path& file, CheckDepth depth,
                  std::stop_token stop = {});

/// For editors: {"problems": [...], "foretold": [...]}. Each problem has file, severity ("error" or
/// "warning"), message, and as far as they are known line and column, end_line and end_column (behind the
/// last character), all from 1, and the path of its key.
std::string toJson(const std::vector<Checked>& files);

}  // namespace espalier::scenes
