#include "render/image/cut_out.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <vector>

#include "render/image/drawing.h"
#include "render/image/tone.h"
#include "sim/base/error.h"
#include "sim/base/parallel.h"

namespace espalier::render {
namespace {

using glm::vec2;
using sim::Colour;

constexpr float kMargin_px = 1.0f;
constexpr int kSamples = 4;  // along each side of a pixel

/// From the body's plane into the picture.
struct Frame2 {
  vec2 low{0.0f}, high{0.0f};
  float scale = 1.0f;
  int width = 0, height = 0;

  vec2 operator()(vec2 p) const {
    return {kMargin_px + (p.x - low.x) * scale, kMargin_px + (high.y - p.y) * scale};
  }
};

Frame2 frameOf(std::span<const CutOutTriangle> body, int most_width_px, int most_height_px) {
  Frame2 frame{vec2(HUGE_VALF), vec2(-HUGE_VALF)};
  float area = 0.0f;
  for (const CutOutTriangle& t : body) {
    for (const vec2 corner : t.corners) {
      frame.low = glm::min(frame.low, corner);
      frame.high = glm::max(frame.high, corner);
    }
    const vec2 u = t.corners[1] - t.corners[0], v = t.corners[2] - t.corners[0];
    area += std::abs(u.x * v.y - u.y * v.x);
  }
  if (!(area > 0.0f))
    throw sim::InputError("a body without area; expected triangles that are seen straight on");
  const vec2 extent = frame.high - frame.low;
  const vec2 room = glm::max(vec2(most_width_px, most_height_px) - 2.0f * kMargin_px, 1.0f);
  frame.scale = std::min(room.x / extent.x, room.y / extent.y);
  const vec2 size = glm::ceil(extent * frame.scale - 0.01f) + 2.0f * kMargin_px;
  frame.width = std::clamp(static_cast<int>(size.x), 1, most_width_px);
  frame.height = std::clamp(static_cast<int>(size.y), 1, most_height_px);
  return frame;
}

bool holds(const std::array<vec2, 3>& c, vec2 p) {
  const auto side = [&](vec2 a, vec2 b) { return (b.x - a.x) * (p.y - a.y) - (b.y - a.y) * (p.x - a.x); };
  const float x = side(c[0], c[1]), y = side(c[1], c[2]), z = side(c[2], c[0]);
  return (x >= 0.0f && y >= 0.0f && z >= 0.0f) || (x <= 0.0f && y <= 0.0f && z <= 0.0f);
}

/// What a row of pixels shows.
struct Cell {
  Colour body{0.0f};  ///< linear
  float cover = 0.0f;
  Colour line{0.0f};
  float on_line = 0.0f;  ///< share
  float rim = 0.0f;
  float near = 0.0f;    ///< to lines: 1 on them
  float furrow = 0.0f;  ///< how deep, px
};

class Sheet {
 public:
  explicit Sheet(const Frame2& frame)
      : frame_(frame),
        cells_(static_cast<std::size_t>(frame.width) * static_cast<std::size_t>(frame.height)) {}

  Cell& at(int x, int y) {
    return cells_[static_cast<std::size_t>(y) * static_cast<std::size_t>(frame_.width) +
                  static_cast<std::size_t>(x)];
  }

  /// Which triangle a sample lies in, the first of them.
  void lay(std::span<const CutOutTriangle> body) {
    constexpr float kShare = 1.0f / (kSamples * kSamples);
    std::vector<std::uint16_t> seen(cells_.size());
    for (const CutOutTriangle& t : body) {
      const std::array corners{frame_(t.corners[0]), frame_(t.corners[1]), frame_(t.corners[2])};
      const vec2 low = glm::min(corners[0], glm::min(corners[1], corners[2]));
      const vec2 high = glm::max(corners[0], glm::max(corners[1], corners[2]));
      forEachPixel(low, high, [&](int x, int y) {
        Cell& cell = at(x, y);
        std::uint16_t& samples = seen[static_cast<std::size_t>(&cell - cells_.data())];
        for (int s = 0; s < kSamples * kSamples; ++s) {
          const auto bit = static_cast<std::uint16_t>(1u << s);
          const vec2 p(static_cast<float>(x) + (static_cast<float>(s % kSamples) + 0.5f) / kSamples,
                       static_cast<float>(y) + (static_cast<float>(s / kSamples) + 0.5f) / kSamples);
          if ((samples & bit) != 0 || !holds(corners, p)) continue;
          samples = static_cast<std::uint16_t>(samples | bit);
          cell.cover += kShare;
          cell.body += kShare * t.colour;
        }
      });
    }
  }

  void draw(const CutOutLine& line, float thickest_px) {
    const vec2 a = frame_(line.from), b = frame_(line.to);
    const float ra = line.from_radius * frame_.scale, rb = line.to_radius * frame_.scale;
    const float reach = 6.0f * std::max(ra, rb) + kReach_px;
    const vec2 way = b - a;
    const float square = std::max(glm::dot(way, way), 1e-12f);
    forEachPixel(glm::min(a, b) - reach, glm::max(a, b) + reach, [&](int x, int y) {
      const vec2 p(static_cast<float>(x) + 0.5f, static_cast<float>(y) + 0.5f);
      const float along = std::clamp(glm::dot(p - a, way) / square, 0.0f, 1.0f);
      const float radius = glm::mix(ra, rb, along);
      const float off = glm::distance(p, a + along * way) - radius;
      Cell& cell = at(x, y);
      // Thinner than a pixel, it covers a share of it.
      const float on = std::clamp(0.5f - off, 0.0f, 1.0f) * std::min(1.0f, 2.0f * radius);
      if (on > cell.on_line) {
        cell.on_line = on;
        cell.line = line.colour;
      }
      const float weight = std::sqrt(std::min(1.0f, radius / thickest_px));
      const float beyond = std::max(off, 0.0f);
      cell.rim = std::max(cell.rim, weight * std::exp(-square_(beyond / (0.8f + 0.5f * radius))));
      cell.near = std::max(cell.near, weight * std::exp(-beyond / (2.0f + 1.5f * radius)));
      cell.furrow =
          std::max(cell.furrow, (0.8f + 0.9f * radius) * std::exp(-beyond / (2.5f + 0.9f * radius)));
    });
  }

  const Frame2& frame() const { return frame_; }

 private:
  static constexpr float kReach_px = 12.0f;
  static float square_(float x) { return x * x; }

  template <class Visit>
  void forEachPixel(vec2 low, vec2 high, Visit visit) {
    const int left = std::max(0, static_cast<int>(std::floor(low.x))),
              right = std::min(frame_.width - 1, static_cast<int>(std::floor(high.x)));
    const int top = std::max(0, static_cast<int>(std::floor(low.y))),
              bottom = std::min(frame_.height - 1, static_cast<int>(std::floor(high.y)));
    for (int y = top; y <= bottom; ++y) {
      for (int x = left; x <= right; ++x) visit(x, y);
    }
  }

  Frame2 frame_;
  std::vector<Cell> cells_;
};

/// Light from the upper left on the vaults between furrows.
float reliefAt(Sheet& sheet, int x, int y) {
  const auto depth = [&](int px, int py) {
    return sheet.at(std::clamp(px, 0, sheet.frame().width - 1), std::clamp(py, 0, sheet.frame().height - 1))
        .furrow;
  };
  const float across = depth(x + 1, y) - depth(x - 1, y), down = depth(x, y + 1) - depth(x, y - 1);
  return std::clamp(0.5f * (0.6f * across + 0.8f * down), -1.0f, 1.0f);
}

Colour meanColour(std::span<const CutOutTriangle> body) {
  Colour sum(0.0f);
  float area = 0.0f;
  for (const CutOutTriangle& t : body) {
    const vec2 u = t.corners[1] - t.corners[0], v = t.corners[2] - t.corners[0];
    const float own = std::abs(u.x * v.y - u.y * v.x);
    sum += own * t.colour;
    area += own;
  }
  return sum / area;
}

}  // namespace

Image drawCutOut(std::span<const CutOutTriangle> body, std::span<const CutOutLine> lines, int most_width_px,
                 int most_height_px) {
  Sheet sheet(frameOf(body, most_width_px, most_height_px));
  sheet.lay(body);
  float thickest_px = 1.0f;
  for (const CutOutLine& line : lines)
    thickest_px = std::max(thickest_px, line.from_radius * sheet.frame().scale);
  for (const CutOutLine& line : lines) sheet.draw(line, thickest_px);
  const Colour mean = srgbFromLinear(meanColour(body));
  Image image(sheet.frame().width, sheet.frame().height, 4);
  sim::parallelForEach(static_cast<std::size_t>(image.height), [&](std::size_t row) {
    for (int x = 0; x < image.width; ++x) {
      const int y = static_cast<int>(row);
      const Cell& cell = sheet.at(x, y);
      float* pixel = image.at(x, y);
      Colour colour = mean;
      if (cell.cover > 0.0f) {
        const Colour blade = srgbFromLinear(cell.body / cell.cover), line = srgbFromLinear(cell.line);
        colour = glm::mix(blade, line, 0.30f * cell.near);
        colour *= 1.0f + 0.30f * reliefAt(sheet, x, y);
        colour *= 1.0f - 0.22f * cell.rim * (1.0f - cell.on_line);
        colour = glm::mix(colour, line, cell.on_line);
      }
      const Colour shown = glm::clamp(colour, 0.0f, 1.0f);
      std::copy_n(&shown.r, 3, pixel);
      pixel[3] = std::min(1.0f, cell.cover);
    }
  });
  return image;
}

Image onPaper(const Image& cut_out) {
  Image image(cut_out.width, cut_out.height, 3);
  for (int y = 0; y < image.height; ++y) {
    for (int x = 0; x < image.width; ++x) {
      const float* const from = cut_out.at(x, y);
      for (std::size_t c = 0; c < 3; ++c)
        image.at(x, y)[c] = glm::mix(kRim[static_cast<int>(c)], from[c], from[3]);
    }
  }
  return image;
}

}  // namespace espalier::render
