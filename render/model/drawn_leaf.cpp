#include "render/model/drawn_leaf.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <mutex>
#include <tuple>

#include <glm/trigonometric.hpp>

#include "render/image/tone.h"
#include "render/model/leaf_canvas.h"
#include "sim/base/error.h"
#include "sim/base/random.h"

namespace espalier::render {
namespace {

using glm::vec2;
using sim::Colour;

constexpr std::size_t kMostLeavesKept = 64;

constexpr Colour kTwig(0.42f, 0.33f, 0.23f);

/// A leaf's colours: display values.
struct Paint {
  Colour blade;
  Colour shaded() const { return 0.88f * blade; }
  Colour vein() const { return glm::mix(blade, Colour(0.86f, 0.90f, 0.62f), 0.42f); }
};

vec2 wayAt(float degrees_from_up) {
  const float angle = glm::radians(degrees_from_up);
  return {std::sin(angle), std::cos(angle)};
}

/// Numbers of one drawing, in [-1, 1).
class Chance {
 public:
  explicit Chance(std::uint64_t stream) : draws_({stream, 0}, sim::Purpose::custom) {}
  float operator()() { return static_cast<float>(2.0 * draws_.uniform() - 1.0); }

 private:
  sim::Draws draws_;
};

void drawOvate(LeafCanvas& leaf, const Paint& paint) {
  const auto half_width = [](float t) {
    const float tooth = std::fmod(t * 15.0f, 1.0f);
    return 0.285f * std::pow(std::sin(3.14159f * std::pow(t, 0.72f)), 0.92f) * (1.0f - 0.028f * tooth);
  };
  const auto middle = bentLine({0.0f, 0.05f}, {0.0f, 0.5f}, {0.0f, 0.995f}, 60);
  leaf.band(
      {{0.0f, 0.0f}, {0.0f, 0.08f}}, [](float) { return 0.014f; }, paint.vein(), paint.vein());
  leaf.band(middle, half_width, paint.blade, paint.shaded());
  for (int i = 0; i < 7; ++i) {
    const float y = 0.13f + 0.105f * static_cast<float>(i);
    const float reach = 0.9f * half_width((y + 0.10f - 0.05f) / 0.945f);
    for (const float side : {-1.0f, 1.0f}) {
      leaf.vein(bentLine({0.0f, y}, {0.6f * side * reach, y + 0.07f}, {side * reach, y + 0.17f}), 0.011f,
                0.003f, {paint.vein(), 0.55f});
    }
  }
  leaf.vein(middle, 0.020f, 0.006f, {paint.vein(), 0.9f});
}

struct Lobe {
  float degrees, length, half_width;
};

/// Lobes about a point, each a band that is widest at `widest` of its length and comes to a point, and a vein
/// along each.
void drawLobes(LeafCanvas& leaf, const Paint& paint, vec2 from, const std::vector<Lobe>& lobes, float widest,
               float sharpness, int teeth) {
  const auto profile = [=](float t) {
    return t < widest ? glm::mix(0.62f, 1.0f, t / widest) : std::pow((1.0f - t) / (1.0f - widest), sharpness);
  };
  leaf.band(
      {{0.0f, 0.0f}, from}, [](float) { return 0.013f; }, paint.vein(), paint.vein());
  for (const Lobe& lobe : lobes) {
    const vec2 way = wayAt(lobe.degrees);
    const bool to_the_right = lobe.degrees > 0.0f;
    const Colour near = to_the_right ? paint.shaded() : paint.blade;
    const Colour far = lobe.degrees == 0.0f ? paint.shaded() : near;
    leaf.band(
        bentLine(from, from + 0.5f * lobe.length * way, from + lobe.length * way, 24),
        [&](float t) { return lobe.half_width * profile(t); }, near, far);
    for (int i = 0; i < teeth; ++i) {
      const float t = 0.42f + 0.40f * static_cast<float>(i) / static_cast<float>(std::max(teeth - 1, 1));
      const float size = lobe.length * (0.25f - 0.28f * (t - 0.42f));
      for (const float side : {-1.0f, 1.0f}) {
        const vec2 base = from + t * lobe.length * way;
        const vec2 tip = base + size * wayAt(lobe.degrees + 42.0f * side);
        leaf.band(
            bentLine(base, 0.5f * (base + tip), tip, 8), [&](float s) { return 0.30f * size * (1.0f - s); },
            near, far);
      }
    }
  }
  for (const Lobe& lobe : lobes) {
    const vec2 way = wayAt(lobe.degrees);
    for (const float t : {0.35f, 0.6f}) {
      for (const float side : {-1.0f, 1.0f}) {
        const vec2 base = from + t * lobe.length * way;
        const vec2 tip =
            base + 0.75f * lobe.half_width * profile(t + 0.12f) * wayAt(lobe.degrees + 48.0f * side);
        leaf.vein({base, tip}, 0.008f, 0.003f, {paint.vein(), 0.5f});
      }
    }
    leaf.vein({from, from + 0.93f * lobe.length * way}, 0.016f, 0.006f, {paint.vein(), 0.85f});
  }
}

void drawNeedles(LeafCanvas& leaf, const Paint& paint) {
  Chance chance(0x6e65);
  leaf.band(
      bentLine({0.0f, 0.0f}, {0.0f, 0.5f}, {0.0f, 0.9f}), [](float t) { return 0.014f - 0.008f * t; }, kTwig,
      0.8f * kTwig);
  const auto needle = [&](float y, float degrees, float length) {
    const vec2 base(0.0f, y);
    const vec2 tip = base + length * wayAt(degrees);
    const vec2 by = base + 0.55f * length * wayAt(degrees * 1.12f);
    const Colour colour = paint.blade * (1.0f + 0.16f * chance());
    leaf.band(
        bentLine(base, by, tip, 6), [](float t) { return 0.0125f * std::pow(1.0f - t * t, 0.7f); }, colour,
        0.8f * colour);
  };
  constexpr int kRows = 30;
  for (int i = 0; i < kRows; ++i) {
    const float t = static_cast<float>(i) / kRows;
    const float length = (0.235f - 0.11f * t * t) * (1.0f + 0.10f * chance());
    for (const float side : {-1.0f, 1.0f})
      needle(0.03f + 0.86f * t + 0.012f * chance(), side * (62.0f - 26.0f * t + 5.0f * chance()), length);
    if (i % 2 == 0) needle(0.04f + 0.86f * t, 26.0f * chance(), 0.6f * length);
  }
  for (const float degrees : {-18.0f, 0.0f, 18.0f}) needle(0.88f, degrees, 0.115f);
}

/// A shoot clad in scales.
void drawShoot(LeafCanvas& leaf, const Paint& paint, vec2 from, float degrees, float length, float half_width,
               float shade) {
  const vec2 tip = from + length * wayAt(degrees);
  const vec2 by = from + 0.5f * length * wayAt(degrees * 1.15f);
  const auto profile = [=](float t) {
    const float scale = std::abs(std::sin(t * length * 70.0f));
    return half_width * (0.72f + 0.28f * scale) * std::sqrt(std::max(0.0f, 1.0f - std::pow(t, 6.0f)));
  };
  const Colour colour = paint.blade * shade;
  leaf.band(bentLine(from, by, tip, 20), profile, colour, 0.82f * colour);
}

void drawBranch(LeafCanvas& leaf, const Paint& paint) {
  Chance chance(0x6272);
  leaf.band(
      bentLine({0.0f, 0.0f}, {0.0f, 0.4f}, {0.0f, 0.6f}), [](float t) { return 0.016f - 0.010f * t; }, kTwig,
      0.8f * kTwig);
  constexpr int kPairs = 12;
  for (int i = 0; i < kPairs; ++i) {
    const float t = static_cast<float>(i) / kPairs;
    const float y = 0.06f + 0.80f * t;
    for (const float side : {-1.0f, 1.0f}) {
      const float length = (0.34f - 0.23f * t) * (1.0f + 0.12f * chance());
      const float degrees = side * (46.0f - 12.0f * t + 5.0f * chance());
      const float at = y + (side > 0.0f ? 0.033f : 0.0f);
      const vec2 base(0.0f, at);
      drawShoot(leaf, paint, base, degrees, length, 0.0145f, 0.9f + 0.08f * chance());
      const int twigs = 2 + static_cast<int>(length * 16.0f);
      for (int k = 1; k < twigs; ++k) {
        const float s = static_cast<float>(k) / static_cast<float>(twigs);
        const float twig = 0.11f * (1.0f - 0.6f * s) * (1.0f + 0.15f * chance());
        for (const float turn : {-34.0f, 34.0f})
          drawShoot(leaf, paint, base + s * length * wayAt(degrees), degrees + turn, twig, 0.0125f,
                    1.0f + 0.12f * chance());
      }
    }
  }
  drawShoot(leaf, paint, {0.0f, 0.3f}, 0.0f, 0.68f, 0.0145f, 1.0f);
  for (const float side : {-1.0f, 1.0f})
    drawShoot(leaf, paint, {0.0f, 0.88f}, side * 30.0f, 0.09f, 0.0125f, 1.1f);
}

void drawBlossom(LeafCanvas& leaf, const Paint& paint) {
  const vec2 centre(0.0f, 0.5f);
  const Colour deep = paint.blade * Colour(0.86f, 0.62f, 0.70f);
  for (int i = 0; i < 5; ++i) {
    const float degrees = 72.0f * static_cast<float>(i);
    const vec2 way = wayAt(degrees);
    const auto petal = bentLine(centre, centre + 0.24f * way, centre + 0.485f * way, 30);
    leaf.band(
        petal,
        [](float t) {
          return 0.225f * std::pow(std::sin(3.14159f * std::pow(0.04f + 0.955f * t, 1.75f)), 0.72f);
        },
        paint.blade, 0.94f * paint.blade);
    for (const float turn : {-16.0f, -8.0f, 0.0f, 8.0f, 16.0f})
      leaf.vein({centre, centre + 0.30f * wayAt(degrees + turn)}, 0.014f, 0.003f, {deep, 0.45f});
  }
  for (int i = 0; i < 15; ++i) {
    const float degrees = 24.0f * static_cast<float>(i) + 8.0f;
    const float length = i % 2 == 0 ? 0.16f : 0.115f;
    const vec2 tip = centre + length * wayAt(degrees);
    leaf.vein({centre, tip}, 0.007f, 0.005f, {Colour(0.97f, 0.95f, 0.80f), 0.9f});
    leaf.vein({tip, tip + 0.012f * wayAt(degrees)}, 0.024f, 0.024f, {Colour(0.90f, 0.68f, 0.20f), 1.0f});
  }
  leaf.vein({centre - vec2(0.004f, 0.0f), centre + vec2(0.004f, 0.0f)}, 0.05f, 0.05f,
            {Colour(0.62f, 0.68f, 0.30f), 1.0f});
}

void drawIvy(LeafCanvas& leaf, const Paint& paint) {
  drawLobes(leaf, paint, {0.0f, 0.21f},
            {{-102.0f, 0.36f, 0.15f},
             {102.0f, 0.36f, 0.15f},
             {-53.0f, 0.58f, 0.185f},
             {53.0f, 0.58f, 0.185f},
             {0.0f, 0.78f, 0.225f}},
            0.38f, 0.85f, 0);
}

void drawPalmate(LeafCanvas& leaf, const Paint& paint) {
  drawLobes(leaf, paint, {0.0f, 0.17f},
            {{-94.0f, 0.38f, 0.085f},
             {94.0f, 0.38f, 0.085f},
             {-46.0f, 0.66f, 0.125f},
             {46.0f, 0.66f, 0.125f},
             {0.0f, 0.82f, 0.140f}},
            0.50f, 0.80f, 3);
}

/// A kind: how wide for its height, which share of that is blade, how it is drawn, and what polygons hold it.
struct Kind {
  float width;
  double blade;
  void (*draw)(LeafCanvas&, const Paint&);
  Cards cards;
};

/// Both halves of a blade by the right rim of its hull, from its foot to its tip: x and y, folded down by
/// `fold` of x.
Cards folded(const std::vector<glm::dvec2>& rim, double fold) {
  std::vector<sim::Vec3> right{{0, rim.front().y, 0}}, left{{0, rim.front().y, 0}};
  for (const glm::dvec2 p : rim) {
    if (p.x != 0.0) right.emplace_back(p.x, p.y, -fold * p.x);
  }
  right.emplace_back(0, rim.back().y, 0);
  left.emplace_back(0, rim.back().y, 0);
  for (auto p = rim.rbegin(); p != rim.rend(); ++p) {
    if (p->x != 0.0) left.emplace_back(-p->x, p->y, -fold * p->x);
  }
  return {right, left};
}

/// Both halves of a flower about its middle, where it is attached, lifted a little at the sides.
Cards cupped() {
  return {{{0, 0, 0}, {0, -0.5, 0}, {0.5, -0.5, 0.1}, {0.5, 0.5, 0.1}, {0, 0.5, 0}},
          {{0, 0, 0}, {0, 0.5, 0}, {-0.5, 0.5, 0.1}, {-0.5, -0.5, 0.1}, {0, -0.5, 0}}};
}

/// Two cards that cross in the middle.
Cards crossed(double width) {
  const double h = 0.5 * width;
  return {{{-h, 0, 0}, {0, 0, 0}, {h, 0, 0}, {h, 1, 0}, {-h, 1, 0}},
          {{0, 0, h}, {0, 0, 0}, {0, 0, -h}, {0, 1, -h}, {0, 1, h}}};
}

const std::map<std::string, Kind>& kinds() {
  static const std::map<std::string, Kind> all = {
      {"ovate",
       {0.60f, 0.597, drawOvate,
        folded({{0, 0}, {0.13, 0.05}, {0.30, 0.28}, {0.30, 0.55}, {0.14, 0.86}, {0, 1}}, 0.22)}},
      {"ivy",
       {1.04f, 0.434, drawIvy,
        folded({{0, 0}, {0.30, 0.0}, {0.42, 0.08}, {0.52, 0.56}, {0.27, 0.62}, {0, 1}}, 0.16)}},
      {"palmate",
       {1.04f, 0.388, drawPalmate,
        folded({{0, 0}, {0.44, 0.0}, {0.52, 0.62}, {0.20, 0.80}, {0.11, 0.96}, {0, 1}}, 0.14)}},
      {"needles", {0.46f, 0.436, drawNeedles, crossed(0.46)}},
      {"branch", {0.56f, 0.496, drawBranch, crossed(0.56)}},
      {"blossom", {1.0f, 0.644, drawBlossom, cupped()}},
  };
  return all;
}

const Kind& kindOf(const std::string& name) {
  const auto found = kinds().find(name);
  if (found != kinds().end()) return found->second;
  throw sim::InputError(
      fmt::format("'{}' is no leaf that is drawn; expected one of {}", name, fmt::join(drawnKinds(), ", ")));
}

}  // namespace

const std::vector<std::string>& drawnKinds() {
  static const std::vector<std::string> names = {"ovate", "ivy", "palmate", "needles", "branch", "blossom"};
  return names;
}

std::shared_ptr<const LeafPicture> drawnLeaf(const std::string& kind, sim::Colour colour) {
  static std::mutex one_at_a_time;
  static std::map<std::tuple<std::string, float, float, float>, std::shared_ptr<const LeafPicture>> drawn;
  const Kind& wanted = kindOf(kind);
  const std::lock_guard lock(one_at_a_time);
  if (drawn.size() >= kMostLeavesKept) drawn.clear();  // a server draws in many colours
  auto& picture = drawn[{kind, colour.r, colour.g, colour.b}];
  if (!picture) {
    const Paint paint{srgbFromLinear(colour)};
    LeafCanvas canvas(wanted.width, paint.blade);
    wanted.draw(canvas, paint);
    picture = std::make_shared<const LeafPicture>(canvas.picture(kind));
  }
  return picture;
}

double bladeShareOf(const std::string& kind) {
  return kindOf(kind).blade;
}

double bladeShareOf(const LeafPicture& picture) {
  const auto blade = std::count_if(picture.texels.begin(), picture.texels.end(), [](const auto& texel) {
    return static_cast<float>(texel[3]) >= kCutout * 255.0f;
  });
  return static_cast<double>(blade) / static_cast<double>(std::max<std::size_t>(picture.texels.size(), 1));
}

Cards cardsOf(const std::string& kind) {
  return kindOf(kind).cards;
}

Cards cardsOf(int width_px, int height_px) {
  const double half = 0.5 * width_px / height_px;
  return folded({{0, 0}, {half, 0}, {half, 1}, {0, 1}}, 0.12);
}

}  // namespace espalier::render
