#include "render/model/leaf_tint.h"

#include <Random123/philox.h>

namespace espalier::render {
namespace {

constexpr std::uint32_t kBladeKey = 0x1eaf;

float unitOf(std::uint32_t bits) {
  return static_cast<float>(bits >> 8) * 0x1p-24f;
}

}  // namespace

sim::Colour leafTint(std::uint32_t piece, const LeafPlace& place, float exposure,
                     const sim::ColourVariation& varies) {
  using sim::Colour;
  const auto bits = r123::Philox4x32()({{piece, 0, 0, 0}}, {{kBladeKey, 0}});
  const auto chance = static_cast<float>(varies.by_chance), age = static_cast<float>(varies.by_age),
             lit = static_cast<float>(varies.by_light), high = static_cast<float>(varies.by_height),
             youth = place.youth;
  const float value = 1.08f + chance * (0.52f * unitOf(bits[0]) - 0.26f);
  const float hue = chance * (2.0f * unitOf(bits[1]) - 1.0f);  // towards blue .. towards yellow
  Colour tint(value * (1.0f + 0.22f * hue), value * (1.0f + 0.04f * hue), value * (1.0f - 0.18f * hue));
  tint *= glm::mix(Colour(1.0f), Colour(1.75f, 1.45f, 1.15f), 0.75f * age * youth * youth * youth);
  const Colour light = glm::mix(Colour(0.80f, 0.90f, 1.05f), Colour(1.18f, 1.08f, 0.92f), exposure);
  tint *= glm::mix(Colour(1.0f), light, lit);
  // As crowns turn in autumn, from the top. Times 1 where nothing is asked for, which changes no bit.
  tint *= glm::mix(Colour(1.0f), Colour(2.5f, 0.95f, 0.55f), high * place.height);
  return glm::max(tint, Colour(0.0f));
}

}  // namespace espalier::render
