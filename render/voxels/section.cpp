#include "render/voxels/section.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "render/image/drawing.h"
#include "render/image/legend.h"
#include "render/image/tone.h"
#include "render/voxels/pale_scene.h"
#include "sim/base/error.h"

namespace espalier::render {
namespace {

constexpr sim::Colour kNearest(0.19f, 0.45f, 0.47f), kFarthest(0.83f, 0.91f, 0.87f);
/// Of occupied voxels, so that they stand out from the tints whatever their colour.
constexpr float kDarken = 0.35f;
constexpr Ink kGrid{sim::Colour(0.1f, 0.12f, 0.14f), 0.16f};

sim::Colour layerTint(int layer, int layers) {
  const float t = layers > 1 ? static_cast<float>(layer - 1) / static_cast<float>(layers - 1) : 0.0f;
  return glm::mix(kNearest, kFarthest, powf(t, 0.8f));
}

}  // namespace

Image drawCells(glm::ivec2 size, int width_px,
                const std::function<std::optional<sim::Colour>(glm::ivec2)>& colour) {
  if (size.x < 1 || size.y < 1 || width_px < 1)
    throw sim::InputError(fmt::format("a section of {} x {} voxels, {} pixels wide; all must be at least 1",
                                      size.x, size.y, width_px));
  const float cell = static_cast<float>(width_px) / static_cast<float>(size.x);
  Image image =
      paper(width_px, std::max(1, static_cast<int>(std::lround(cell * static_cast<float>(size.y)))));
  const float height = static_cast<float>(image.height);

  const auto corner = [&](int i, int j) {
    return glm::vec2(static_cast<float>(i) * cell, height - static_cast<float>(j) * cell);
  };
  for (int j = 0; j < size.y; ++j) {
    for (int i = 0; i < size.x; ++i) {
      if (const auto here = colour({i, j})) fillBox(image, corner(i, j + 1), corner(i + 1, j), {*here, 1.0f});
    }
  }
  // Lines closer than three pixels would only darken the picture.
  if (cell >= 3.0f) {
    const float width = std::clamp(0.05f * cell, 0.6f, 1.5f);
    for (int i = 1; i < size.x; ++i) drawSegment(image, corner(i, 0), corner(i, size.y), width, kGrid);
    for (int j = 1; j < size.y; ++j) drawSegment(image, corner(0, j), corner(size.x, j), width, kGrid);
  }
  return image;
}

Image drawSection(const std::function<Cut(glm::ivec2)>& cut, const SectionLook& look) {
  Image image = drawCells(look.size, look.width_px, [&](glm::ivec2 v) -> std::optional<sim::Colour> {
    const Cut here = cut(v);
    if (here.occupied) return srgbFromLinear(kDarken * here.colour);
    if (here.layer < 1 || here.layer > look.layers) return std::nullopt;
    return layerTint(here.layer, look.layers);
  });
  SwatchLegend legend{look.title, "", {}};
  for (int layer = 1; layer <= look.layers; ++layer)
    legend.swatches.push_back({layerTint(layer, look.layers), fmt::format("layer {}", layer)});
  if (!legend.swatches.empty()) drawLegend(image, legend);
  return image;
}

}  // namespace espalier::render
