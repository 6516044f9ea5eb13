#include "render/image/drawing.h"

#include <fmt/format.h>
#include <sstream>

#include <algorithm>
#include <array>
#include <cmath>
#include <sstream>
#include <utility>

#include "render/image/oiio.h"
#include "sim/base/error.h"

// OpenImageIO draws text, resizes and copies. Its lines and boxes have hard edges one pixel wide, so those
// two are laid down here by the share of each pixel that they cover.
namespace espalier::render {
namespace {

const char* fontName(Font font) {
  return font == Font::bold ? "DejaVuSans-Bold" : "DejaVuSans";
}

/// Letters are set this many times larger and then reduced: free of the font's hinting, with even spacing.
constexpr int kTextScale = 4;

/// note: OpenImageIO 2.4 decodes UTF-8 wrongly (a degree sign comes out as "0"), so what is not ASCII is
/// drawn as a question mark, one a character.
std::string drawable(const std::string& text) {
  std::string out;
  for (const char c : text) {
    const unsigned char byte = static_cast<unsigned char>(c);
    if (byte >= 0x80 && byte < 0xc0) continue;  // the rest of a character begun before
    out += byte >= 0x80 ? '?' : byte < 0x20 ? ' ' : c;
  }
  return out;
}

int enlarged(float size_px) {
  return static_cast<int>(std::lround(size_px * kTextScale));
}

TextBox textBounds(const std::string& text, float size_px, Font font) {
  const std::optional<TextBox> bounds = oiio().text_box(text, enlarged(size_px), fontName(font));
  if (!bounds) {
    throw sim::InputError(fmt::format(
        "cannot find the font {} for the text in pictures; install fonts-dejavu-core", fontName(font)));
  }
  return *bounds;
}

void blend(Image& image, int x, int y, const Ink& ink, float coverage) {
  const float share = coverage * ink.opacity;
  float* pixel = image.at(x, y);
  for (int c = 0; c < 3; ++c) pixel[c] += share * (ink.colour[c] - pixel[c]);
}

/// The pixels that a shape between two corners may touch.
struct Reach {
  int x0, y0, x1, y1;
};
Reach reachOf(const Image& image, glm::vec2 low, glm::vec2 high) {
  const auto within = [](float v, int most) {
    return static_cast<int>(std::clamp(v, 0.0f, static_cast<float>(most)));
  };
  return {within(std::floor(low.x), image.width), within(std::floor(low.y), image.height),
          within(std::ceil(high.x), image.width), within(std::ceil(high.y), image.height)};
}

template <typename Coverage>
void cover(Image& image, const Reach& reach, const Ink& ink, Coverage coverage) {
  for (int y = reach.y0; y < reach.y1; ++y) {
    for (int x = reach.x0; x < reach.x1; ++x) {
      const float share = coverage(glm::vec2(static_cast<float>(x) + 0.5f, static_cast<float>(y) + 0.5f));
      if (share > 0.0f) blend(image, x, y, ink, std::min(share, 1.0f));
    }
  }
}

}  // namespace

float textWidth(const std::string& text, float size_px, Font font) {
  const std::string shown = drawable(text);
  if (shown.empty()) return 0.0f;
  const TextBox bounds = textBounds(shown, size_px, font);
  return static_cast<float>(bounds.right - bounds.left) / kTextScale;
}

void drawText(Image& image, glm::vec2 at, const std::string& text, const TextStyle& style) {
  const std::string shown = drawable(text);
  if (shown.empty()) return;
  const TextBox bounds = textBounds(shown, style.size_px, style.font);
  const int wide = bounds.right - bounds.left;
  const float width = static_cast<float>(wide) / kTextScale;
  const float shift = style.align == Align::left ? 0.0f : style.align == Align::centre ? 0.5f : 1.0f;

  // The text's place in the enlarged picture, and the whole pixels around it.
  const int left = static_cast<int>(std::lround((at.x - shift * width) * kTextScale));
  const int base = static_cast<int>(std::lround(at.y * kTextScale));
  const auto floorDiv = [](int v) {
    return static_cast<int>(std::floor(static_cast<float>(v) / kTextScale));
  };
  const int x0 = floorDiv(left) - 1, x1 = floorDiv(left + wide) + 2;
  const int y0 = floorDiv(base + bounds.top) - 1, y1 = floorDiv(base + bounds.bottom) + 2;

  Image mask((x1 - x0) * kTextScale, (y1 - y0) * kTextScale, 1);
  oiio().text(mask, left - bounds.left - x0 * kTextScale, base - y0 * kTextScale, shown,
              enlarged(style.size_px), fontName(style.font));
  for (int y = std::max(0, y0); y < std::min(image.height, y1); ++y) {
    for (int x = std::max(0, x0); x < std::min(image.width, x1); ++x) {
      float sum = 0.0f;
      for (int j = 0; j < kTextScale; ++j)
        for (int i = 0; i < kTextScale; ++i)
          sum += *mask.at((x - x0) * kTextScale + i, (y - y0) * kTextScale + j);
      if (sum > 0.0f) blend(image, x, y, style.ink, sum / (kTextScale * kTextScale));
    }
  }
}

std::vector<std::string> linesOf(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream in(text);
  for (std::string line; std::getline(in, line);) lines.push_back(line);
  return lines;
}

void drawSegment(Image& image, glm::vec2 a, glm::vec2 b, float width_px, Ink ink) {
  // Thinner than a pixel is a pixel wide and fainter.
  ink.opacity *= std::min(1.0f, width_px);
  const float half = 0.5f * std::max(1.0f, width_px);
  const glm::vec2 along = b - a;
  const float length2 = glm::dot(along, along);
  const float near = half + 1.0f;
  const Reach all = reachOf(image, glm::min(a, b) - near, glm::max(a, b) + near);
  for (int y = all.y0; y < all.y1; ++y) {
    // Pixels of this row are touched by the part of the segment that is as near to the row.
    const float from_a = static_cast<float>(y) + 0.5f - a.y;
    const auto at = [&](float up) {
      return along.y != 0.0f ? std::clamp((from_a + up) / along.y, 0.0f, 1.0f) : up < 0.0f ? 0.0f : 1.0f;
    };
    const float x0 = a.x + at(-near) * along.x, x1 = a.x + at(near) * along.x;
    const Reach row = reachOf(image, {std::min(x0, x1) - near, 0.0f}, {std::max(x0, x1) + near, 0.0f});
    cover(image, {row.x0, y, row.x1, y + 1}, ink, [&](glm::vec2 p) {
      const float t = length2 > 0.0f ? std::clamp(glm::dot(p - a, along) / length2, 0.0f, 1.0f) : 0.0f;
      return half + 0.5f - glm::length(p - a - t * along);
    });
  }
}

void fillTriangle(Image& image, glm::vec2 a, glm::vec2 b, glm::vec2 c, Ink ink) {
  fillConvex(image, std::array{a, b, c}, ink);
}

void fillConvex(Image& image, std::span<const glm::vec2> corners, Ink ink) {
  const auto twice = [](glm::vec2 u, glm::vec2 v) { return u.x * v.y - u.y * v.x; };
  const auto next = [&](std::size_t i) { return corners[i + 1 < corners.size() ? i + 1 : 0]; };
  float area = 0.0f;
  glm::vec2 low(INFINITY), high(-INFINITY);
  for (std::size_t i = 0; i < corners.size(); ++i) {
    area += twice(corners[i] - corners[0], next(i) - corners[0]);
    low = glm::min(low, corners[i]);
    high = glm::max(high, corners[i]);
  }
  if (!(std::abs(area) > 0.0f)) return;
  cover(image, reachOf(image, low - 1.0f, high + 1.0f), ink, [&](glm::vec2 p) {
    float inside = INFINITY;  // how far from the nearest side, in pixels
    for (std::size_t i = 0; i < corners.size(); ++i) {
      const glm::vec2 side = next(i) - corners[i];
      const float length = glm::length(side);
      if (length > 0.0f)
        inside = std::min(inside, std::copysign(1.0f, area) * twice(side, p - corners[i]) / length);
    }
    return inside + 0.5f;
  });
}

void fillBox(Image& image, glm::vec2 low, glm::vec2 high, Ink ink, float corner_radius_px) {
  const glm::vec2 middle = 0.5f * (low + high);
  const glm::vec2 half = 0.5f * (high - low);
  const float radius = std::min({corner_radius_px, half.x, half.y});
  cover(image, reachOf(image, low, high), ink, [&](glm::vec2 p) {
    const glm::vec2 overlap = glm::min(p + 0.5f, high) - glm::max(p - 0.5f, low);
    if (overlap.x <= 0.0f || overlap.y <= 0.0f) return 0.0f;
    const glm::vec2 beyond = glm::abs(p - middle) - (half - radius);
    if (radius <= 0.0f || beyond.x <= 0.0f || beyond.y <= 0.0f) return overlap.x * overlap.y;
    return std::max(0.0f, radius + 0.5f - glm::length(beyond));
  });
}

void paste(Image& onto, const Image& picture, int x, int y) {
  oiio().paste(onto, picture, x, y);
}

Image resized(const Image& image, int width_px, int height_px) {
  Image small(width_px, height_px, image.channels);
  oiio().resize(image, small);
  return small;
}

}  // namespace espalier::render
