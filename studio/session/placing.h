#pragma once
#include <cstddef>
#include <string>
#include <vector>

#include "scenes/scene.h"

/// Changes of a scene's text that put something elsewhere, and leave its words and its layout as they are.
namespace espalier::studio {

/// Lines and columns from 1, in characters; `to` behind the last.
struct TextEdit {
  struct At {
    int line = 1, column = 1;
  };
  At from, to;
  std::string insert;
};

/// Where the text has a place of a seed: the three numbers. Throws InputError where the text has no such
/// seed, such as one of a table or strewn.
std::vector<TextEdit> seedMoved(const std::string& text, const scenes::Scene& scene,
                                const std::string& planting, std::size_t seed, sim::Vec3 to_m);
/// One more seed behind the last that is written. Throws InputError where the planting has none there.
std::vector<TextEdit> seedAdded(const std::string& text, const scenes::Scene& scene,
                                const std::string& planting, sim::Vec3 at_m);
/// Where a camera stands and looks; one of a new name is added. Throws InputError for a name that is none,
/// and for a text that cannot be read.
std::vector<TextEdit> cameraSet(const std::string& text, const std::string& name, sim::Vec3 eye_m,
                                sim::Vec3 target_m);

/// The answer that tells the page.
std::string changeJson(const std::string& file, const std::vector<TextEdit>& edits);

}  // namespace espalier::studio
