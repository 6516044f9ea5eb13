#include "render/model/leaf_canvas.h"

#include <algorithm>
#include <cmath>

#include "render/image/image_io.h"
#include "sim/base/vec.h"

namespace espalier::render {
namespace {

constexpr int kHeight = 256;  // of the picture; it is drawn twice as large
constexpr int kFiner = 2;

std::uint8_t byteOf(float value) {
  return static_cast<std::uint8_t>(std::lround(std::clamp(value, 0.0f, 1.0f) * 255.0f));
}

glm::vec2 leftOf(glm::vec2 way) {
  const float length = glm::length(way);
  return length > 0.0f ? glm::vec2(-way.y, way.x) / length : glm::vec2(0.0f);
}

}  // namespace

LeafCanvas::LeafCanvas(float width, sim::Colour ground)
    : width_(width),
      colour_(kFiner * static_cast<int>(std::lround(width * kHeight)), kFiner * kHeight, 3),
      mask_(colour_.width, colour_.height, 3) {
  for (std::size_t i = 0; i < colour_.pixels.size(); ++i) colour_.pixels[i] = ground[static_cast<int>(i % 3)];
}

glm::vec2 LeafCanvas::pixel(glm::vec2 at) const {
  return {(at.x / width_ + 0.5f) * static_cast<float>(colour_.width),
          (1.0f - at.y) * static_cast<float>(colour_.height)};
}

/// Two triangles, and their seam.
void LeafCanvas::quad(Image& image, const std::array<glm::vec2, 4>& corners, Ink ink) const {
  fillTriangle(image, corners[0], corners[1], corners[2], ink);
  fillTriangle(image, corners[0], corners[2], corners[3], ink);
  drawSegment(image, corners[0], corners[2], 1.0f, ink);
}

void LeafCanvas::band(const std::vector<glm::vec2>& curve, const HalfWidth& half_width, sim::Colour left,
                      sim::Colour right) {
  constexpr float kOverlap = 0.8f;  // pixels, so that no seam is seen between pieces
  const std::size_t last = curve.size() - 1;
  for (const float side : {1.0f, -1.0f}) {
    const Ink ink{side > 0.0f ? left : right};
    for (std::size_t i = 0; i < last; ++i) {
      const auto across = [&](std::size_t k) {
        return leftOf(curve[std::min(k + 1, last)] - curve[k == 0 ? 0 : k - 1]) * side *
               half_width(static_cast<float>(k) / static_cast<float>(last));
      };
      const glm::vec2 a = pixel(curve[i]), b = pixel(curve[i + 1]);
      const glm::vec2 on = b == a ? glm::vec2(0.0f) : kOverlap * glm::normalize(b - a);
      const glm::vec2 rim_a = pixel(curve[i] + across(i)), rim_b = pixel(curve[i + 1] + across(i + 1));
      const std::array<glm::vec2, 4> corners{a, b + on, rim_b + on, rim_a};
      quad(colour_, corners, ink);
      quad(mask_, corners, {sim::Colour(1.0f)});
    }
  }
}

void LeafCanvas::vein(const std::vector<glm::vec2>& curve, float from_width, float to_width, Ink ink) {
  const float scale = static_cast<float>(colour_.height);
  for (std::size_t i = 0; i + 1 < curve.size(); ++i) {
    const float t = static_cast<float>(i) / static_cast<float>(curve.size() - 1);
    drawSegment(colour_, pixel(curve[i]), pixel(curve[i + 1]), scale * glm::mix(from_width, to_width, t),
                ink);
  }
}

LeafPicture LeafCanvas::picture(const std::string& name) const {
  const int width = colour_.width / kFiner;
  const Image colour = resized(colour_, width, kHeight), mask = resized(mask_, width, kHeight);
  Image joined(width, kHeight, 4);
  LeafPicture picture{name, width, kHeight, {}, {}};
  for (int y = 0; y < kHeight; ++y) {
    for (int x = 0; x < width; ++x) {
      float* const to = joined.at(x, y);
      std::copy_n(colour.at(x, y), 3, to);
      to[3] = *mask.at(x, y);
      picture.texels.push_back({byteOf(to[0]), byteOf(to[1]), byteOf(to[2]), byteOf(to[3])});
    }
  }
  picture.png = encodePng(joined);
  return picture;
}

std::vector<glm::vec2> bentLine(glm::vec2 from, glm::vec2 by, glm::vec2 to, int pieces) {
  std::vector<glm::vec2> points;
  for (int i = 0; i <= pieces; ++i) {
    const float t = static_cast<float>(i) / static_cast<float>(pieces);
    points.push_back(glm::mix(glm::mix(from, by, t), glm::mix(by, to, t), t));
  }
  return points;
}

}  // namespace espalier::render
