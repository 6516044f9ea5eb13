#include "render/voxels/section.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "render/image/drawing.h"
#include "render/image/legend.h"
#include "render/image/tone.h"
#include "sim/base/error.h"

namespace espalier::render {
namespace {

constexpr sim::Colour kPaper(0.985f, 0.98f, 0.97f);
constexpr sim::Colour kNearest(0.19f, 0.45f, 0.47f), kFarthest(0.83f, 0.91f, 0.87f);
/// Of occupied voxels, so that they stand out from the tints whatever their colour.
constexpr float kDarken = 0.35f;
constexpr Ink kGrid{sim::Colour(0.1f, 0.12f, 0.14f), 0.16f};

sim::Colour layerTint(int layer, int layers) {
  const float t = layers > 1 ? static_cast<float>(layer - 1) / static_cast<float>(layers - 1) : 0.0f;
  return glm::mix(kNearest, kFarthest, powf(t, 0.8f));
}

}  // namespace

Image drawSection(const std::function<Cut(glm::ivec2)>& cut, const SectionLook& look) {
  if (look.size.x < 1 || look.size.y < 1 || look.width_px < 1)
    throw sim::InputError(fmt::format("a section of {} x {} voxels, {} pixels wide; all must be at least 1",
                                      look.size.x, look.size.y, look.width_px));
  const float cell = static_cast<float>(look.width_px) / static_cast<float>(look.size.x);
  Image image(look.width_px,
              std::max(1, static_cast<int>(std::lround(cell * static_cast<float>(look.size.y)))), 3);
  const glm::vec2 extent(static_cast<float>(image.width), static_cast<float>(image.height));
  fillBox(image, {0, 0}, extent, {kPaper, 1.0f});

  const auto corner = [&](int i, int j) {
    return glm::vec2(static_cast<float>(i) * cell, extent.y - static_cast<float>(j) * cell);
  };
  for (int j = 0; j < look.size.y; ++j) {
    for (int i = 0; i < look.size.x; ++i) {
      const Cut here = cut({i, j});
      if (!here.occupied && (here.layer < 1 || here.layer > look.layers)) continue;
      const sim::Colour colour =
          here.occupied ? srgbFromLinear(kDarken * here.colour) : layerTint(here.layer, look.layers);
      fillBox(image, corner(i, j + 1), corner(i + 1, j), {colour, 1.0f});
    }
  }
  // Lines closer than three pixels would only darken the picture.
  if (cell >= 3.0f) {
    const float width = std::clamp(0.05f * cell, 0.6f, 1.5f);
    for (int i = 1; i < look.size.x; ++i)
      drawSegment(image, corner(i, 0), corner(i, look.size.y), width, kGrid);
    for (int j = 1; j < look.size.y; ++j)
      drawSegment(image, corner(0, j), corner(look.size.x, j), width, kGrid);
  }
  SwatchLegend legend{look.title, "", {}};
  for (int layer = 1; layer <= look.layers; ++layer)
    legend.swatches.push_back({layerTint(layer, look.layers), fmt::format("layer {}", layer)});
  if (!legend.swatches.empty()) drawLegend(image, legend);
  return image;
}

}  // namespace espalier::render
