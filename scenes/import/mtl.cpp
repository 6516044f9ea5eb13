#include "scenes/import/mtl.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "scenes/clean_text.h"
#include "scenes/import/obj_statements.h"
#include "sim/base/srgb.h"

namespace espalier::scenes {
namespace {

/// Red, green and blue, or one number for all.
std::optional<sim::Colour> colourOf(ObjStatements& statement) {
  sim::Colour colour;
  for (int c = 0; c < 3; ++c) {
    const std::string_view word = statement.takeNumber();
    const std::optional<float> value = word.empty() && c == 1 ? colour.r : numberOf(word);
    if (!value) return std::nullopt;
    colour[c] = *value;
    if (word.empty()) return sim::Colour(*value);
  }
  return colour;
}

}  // namespace

sim::Material unknownMaterial(const std::string& name) {
  return {name, sim::Colour(sim::linearFromSrgb(0.6f))};
}

int readMtl(std::string_view mtl, MtlMaterials& materials) {
  int wrong_line = 0;
  sim::Material* material = nullptr;
  for (ObjStatements statement(mtl); statement.next();) {
    if (statement.keyword() == "newmtl") {
      const std::string name(statement.rest());
      material = &materials.try_emplace(name, unknownMaterial(cleanText(name))).first->second;
    } else if ((statement.keyword() == "Kd" || statement.keyword() == "kd") && material != nullptr) {
      const auto colour = colourOf(statement);
      if (!colour) {
        if (wrong_line == 0) wrong_line = statement.line();
        continue;
      }
      for (int c = 0; c < 3; ++c)
        material->colour[c] = sim::linearFromSrgb(std::clamp((*colour)[c], 0.0f, 1.0f));
    }
  }
  return wrong_line;
}

}  // namespace espalier::scenes
