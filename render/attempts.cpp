#include "render/attempts.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "render/drawing.h"
#include "sim/error.h"

namespace espalier::render {
namespace {

constexpr sim::Colour kSheet(0.965f, 0.957f, 0.94f), kPaper(0.995f, 0.992f, 0.985f);
constexpr Ink kBorder{sim::Colour(0.2f, 0.2f, 0.2f), 0.5f};
constexpr Ink kGrid{sim::Colour(0.25f, 0.3f, 0.35f), 0.13f};
constexpr Ink kTakenVoxel{sim::Colour(0.66f, 0.74f, 0.62f), 0.85f};
constexpr Ink kRejected{sim::Colour(0.78f, 0.40f, 0.24f), 0.55f};
constexpr Ink kTaken{sim::Colour(0.09f, 0.10f, 0.11f), 1.0f};

/// One of the two frames: a rectangle of paper and the converter from voxels to its pixels.
struct FrameOnSheet {
  glm::vec2 low, extent;
  float cell;

  glm::vec2 pixel(glm::dvec2 voxel) const {
    const glm::vec2 at(static_cast<float>(voxel.x + 0.5), static_cast<float>(voxel.y + 0.5));
    return {low.x + at.x * cell, low.y + extent.y - at.y * cell};
  }
};

void drawAll(Image& image, const FrameOnSheet& frame, std::span<const Attempt> attempts, bool taken,
             float width_px, Ink ink) {
  for (const Attempt& attempt : attempts)
    if (attempt.taken == taken)
      drawSegment(image, frame.pixel(attempt.a), frame.pixel(attempt.b), width_px, ink);
}

}  // namespace

Image drawAttempts(std::span<const Attempt> attempts, std::span<const glm::ivec2> occupied,
                   const AttemptsLook& look) {
  if (look.size.x < 1 || look.size.y < 1 || look.frame_width_px < 1)
    throw sim::InputError(fmt::format("a walk over {} x {} voxels, {} pixels wide; all must be at least 1",
                                      look.size.x, look.size.y, look.frame_width_px));
  const float cell = static_cast<float>(look.frame_width_px) / static_cast<float>(look.size.x);
  const int height = std::max(1, static_cast<int>(std::lround(cell * static_cast<float>(look.size.y))));
  const int margin = std::max(4, look.frame_width_px / 24);
  Image image(2 * look.frame_width_px + 3 * margin, height + 2 * margin, 3);
  fillBox(image, {0, 0}, {static_cast<float>(image.width), static_cast<float>(image.height)}, {kSheet, 1.0f});

  const glm::vec2 extent(static_cast<float>(look.frame_width_px), static_cast<float>(height));
  const float m = static_cast<float>(margin);
  const FrameOnSheet left{{m, m}, extent, cell}, right{{2 * m + extent.x, m}, extent, cell};
  for (const FrameOnSheet& frame : {left, right}) {
    fillBox(image, frame.low - 1.0f, frame.low + extent + 1.0f, kBorder);
    fillBox(image, frame.low, frame.low + extent, {kPaper, 1.0f});
  }

  for (const glm::ivec2 v : occupied) {
    const glm::vec2 centre = left.pixel(glm::dvec2(v));
    fillBox(image, glm::max(centre - 0.5f * cell, left.low),
            glm::min(centre + 0.5f * cell, left.low + extent), kTakenVoxel);
  }
  if (cell >= 3.0f) {
    for (int i = 1; i < look.size.x; ++i)
      drawSegment(image, left.pixel({i - 0.5, -0.5}), left.pixel({i - 0.5, look.size.y - 0.5}), 1.0f, kGrid);
    for (int j = 1; j < look.size.y; ++j)
      drawSegment(image, left.pixel({-0.5, j - 0.5}), left.pixel({look.size.x - 0.5, j - 0.5}), 1.0f, kGrid);
  }
  const float line = std::clamp(0.09f * cell, 0.7f, 3.0f);
  drawAll(image, left, attempts, false, 0.7f * line, kRejected);
  drawAll(image, left, attempts, true, 1.6f * line, kTaken);
  drawAll(image, right, attempts, true, 1.8f * line, kTaken);
  return image;
}

}  // namespace espalier::render
