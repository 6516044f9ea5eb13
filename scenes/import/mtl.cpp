#include "scenes/import/mtl.h"

#include <algorithm>
#include <array>
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

std::string_view takePart(std::string_view& text) {
  const std::size_t end = std::min(text.find_first_of(" \t"), text.size());
  const std::string_view word = text.substr(0, end);
  text.remove_prefix(std::min(text.find_first_not_of(" \t", end), text.size()));
  return word;
}

/// Options, and behind them a file's name, which may have spaces.
void readPicture(std::string_view rest, MtlMaterial& material) {
  struct Option {
    std::string_view name;
    int words;  // behind it; of numbers at most three
  };
  static constexpr std::array<Option, 12> kOptions{{{"-blendu", 1},
                                                    {"-blendv", 1},
                                                    {"-boost", 1},
                                                    {"-mm", 2},
                                                    {"-o", 0},
                                                    {"-s", 0},
                                                    {"-t", 0},
                                                    {"-texres", 1},
                                                    {"-clamp", 1},
                                                    {"-bm", 1},
                                                    {"-imfchan", 1},
                                                    {"-type", 1}}};
  for (;;) {
    std::string_view after = rest;
    const std::string_view name = takePart(after);
    const auto option =
        std::find_if(kOptions.begin(), kOptions.end(), [&](const Option& o) { return o.name == name; });
    if (option == kOptions.end()) break;
    rest = after;
    if (option->words > 0) {
      for (int i = 0; i < option->words; ++i) {
        const std::string_view word = takePart(rest);
        if (name == "-clamp") material.clamps = word == "on";
      }
      continue;
    }
    for (int i = 0; i < 3; ++i) {
      after = rest;
      const auto number = numberOf(takePart(after));
      if (!number) break;
      rest = after;
      if (i < 2 && name == "-s") material.scale[i] = *number;
      if (i < 2 && name == "-o") material.offset[i] = *number;
    }
  }
  material.picture = rest;
  std::replace(material.picture.begin(), material.picture.end(), '\\', '/');
}

struct NamedColour {
  std::string_view keyword, other;
  sim::Colour sim::Material::*member;
};

/// The colour of a material that a keyword gives.
const NamedColour* colourNamed(std::string_view keyword) {
  static constexpr std::array<NamedColour, 2> kColours{
      {{"Kd", "kd", &sim::Material::colour}, {"Ke", "ke", &sim::Material::emissive}}};
  const auto at = std::find_if(kColours.begin(), kColours.end(), [&](const NamedColour& named) {
    return named.keyword == keyword || named.other == keyword;
  });
  return at == kColours.end() ? nullptr : &*at;
}

}  // namespace

sim::Material unknownMaterial(const std::string& name) {
  return {name, sim::Colour(sim::linearFromSrgb(0.6f))};
}

int readMtl(std::string_view mtl, MtlMaterials& materials) {
  int wrong_line = 0;
  MtlMaterial* material = nullptr;
  for (ObjStatements statement(mtl); statement.next();) {
    if (statement.keyword() == "newmtl") {
      const std::string name(statement.rest());
      material =
          &materials.try_emplace(name, MtlMaterial{unknownMaterial(cleanText(name)), {}}).first->second;
    } else if (const auto* const own = colourNamed(statement.keyword()); own && material != nullptr) {
      const auto colour = colourOf(statement);
      if (!colour) {
        if (wrong_line == 0) wrong_line = statement.line();
        continue;
      }
      for (int c = 0; c < 3; ++c)
        (material->material.*own->member)[c] = sim::linearFromSrgb(std::clamp((*colour)[c], 0.0f, 1.0f));
    } else if (statement.keyword() == "d" && material != nullptr) {
      const auto opacity = numberOf(statement.takeNumber());
      if (opacity) sim::setOpacity(material->material, std::clamp(*opacity, 0.0f, 1.0f));
      if (!opacity && wrong_line == 0) wrong_line = statement.line();
    } else if ((statement.keyword() == "map_Kd" || statement.keyword() == "map_kd") && material != nullptr) {
      readPicture(statement.rest(), *material);
    }
  }
  return wrong_line;
}

}  // namespace espalier::scenes
