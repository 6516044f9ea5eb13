#include "render/voxels/attempts.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "render/image/drawing.h"
#include "sim/base/error.h"

namespace espalier::render {
namespace {

constexpr sim::Colour kSheet(0.965f, 0.957f, 0.94f), kPaper(0.995f, 0.992f, 0.985f);
constexpr Ink kBorder{sim::Colour(0.2f, 0.2f, 0.2f), 0.5f};
constexpr Ink kSquares{sim::Colour(0.25f, 0.3f, 0.35f), 0.13f};
constexpr Ink kTakenVoxel{sim::Colour(0.66f, 0.74f, 0.62f), 0.85f};
constexpr Ink kRejected{sim::Colour(0.78f, 0.40f, 0.24f), 0.55f};
constexpr Ink kTaken{sim::Colour(0.09f, 0.10f, 0.11f), 1.0f};

/// One of the two frames: paper, and the converter from voxels to its pixels.
struct Frame {
  Image paper;
  float cell;

  glm::vec2 pixel(glm::dvec2 voxel) const {
    return {static_cast<float>(voxel.x + 0.5) * cell,
            static_cast<float>(paper.height) - static_cast<float>(voxel.y + 0.5) * cell};
  }
  void box(glm::dvec2 low, glm::dvec2 high, Ink ink) {
    fillBox(paper, {pixel(low).x, pixel(high).y}, {pixel(high).x, pixel(low).y}, ink);
  }
  void all(std::span<const Attempt> attempts, bool taken, float width_px, Ink ink) {
    for (const Attempt& attempt : attempts)
      if (attempt.taken == taken) drawSegment(paper, pixel(attempt.a), pixel(attempt.b), width_px, ink);
  }
};

void fill(Image& image, Ink ink) {
  fillBox(image, {0, 0}, {static_cast<float>(image.width), static_cast<float>(image.height)}, ink);
}

}  // namespace

Image drawAttempts(std::span<const Attempt> attempts, std::span<const glm::ivec2> occupied,
                   const AttemptsLook& look) {
  if (look.size.x < 1 || look.size.y < 1 || look.frame_width_px < 1)
    throw sim::InputError(fmt::format("a walk over {} x {} voxels, {} pixels wide; all must be at least 1",
                                      look.size.x, look.size.y, look.frame_width_px));
  const int width = look.frame_width_px;
  const float cell = static_cast<float>(width) / static_cast<float>(look.size.x);
  const int height = std::max(1, static_cast<int>(std::lround(cell * static_cast<float>(look.size.y))));
  Frame left{Image(width, height, 3), cell};
  fill(left.paper, {kPaper, 1.0f});
  Frame right = left;

  for (const glm::ivec2 v : occupied) left.box(glm::dvec2(v) - 0.5, glm::dvec2(v) + 0.5, kTakenVoxel);
  if (cell >= 3.0f) {
    const glm::dvec2 end = glm::dvec2(look.size) - 0.5;
    for (int i = 1; i < look.size.x; ++i)
      drawSegment(left.paper, left.pixel({i - 0.5, -0.5}), left.pixel({i - 0.5, end.y}), 1.0f, kSquares);
    for (int j = 1; j < look.size.y; ++j)
      drawSegment(left.paper, left.pixel({-0.5, j - 0.5}), left.pixel({end.x, j - 0.5}), 1.0f, kSquares);
  }
  const float line = std::clamp(0.09f * cell, 0.7f, 3.0f);
  left.all(attempts, false, 0.7f * line, kRejected);
  left.all(attempts, true, 1.6f * line, kTaken);
  right.all(attempts, true, 1.8f * line, kTaken);

  const int margin = std::max(4, width / 24);
  Image sheet(2 * width + 3 * margin, height + 2 * margin, 3);
  fill(sheet, {kSheet, 1.0f});
  int x = margin;
  for (const Frame& frame : {std::cref(left), std::cref(right)}) {
    const glm::vec2 low(static_cast<float>(x), static_cast<float>(margin));
    const glm::vec2 extent(static_cast<float>(width), static_cast<float>(height));
    fillBox(sheet, low - 1.0f, low + extent + 1.0f, kBorder);
    paste(sheet, frame.paper, x, margin);
    x += width + margin;
  }
  return sheet;
}

}  // namespace espalier::render
