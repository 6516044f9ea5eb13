#include "render/image/arrow_drawing.h"

#include <algorithm>
#include <numeric>

#include "render/image/drawing.h"

namespace espalier::render {
namespace {

constexpr sim::Colour kAxes[3] = {{0.80f, 0.17f, 0.11f}, {0.10f, 0.53f, 0.22f}, {0.12f, 0.33f, 0.76f}};
constexpr float kFarHaze = 0.55f;  // what is farthest is mixed with the rim's colour so far
constexpr float kHeadWidth = 4.2f, kHeadLength = 4.6f;  // of a head, in widths of its shaft
constexpr float kLongestHead = 0.5f;                    // of an arrow's length

struct Seen {
  glm::vec2 from, to;
  double depth_m;
  float width;
  sim::Colour colour;
  bool hidden;
};

/// A shaft and a head, each a little larger for a rim.
void drawOne(Image& picture, const Seen& arrow, Ink ink, float rim) {
  const glm::vec2 along = arrow.to - arrow.from;
  const float length = glm::length(along);
  const float head = std::min(kHeadLength * arrow.width, kLongestHead * length);
  if (!(length > 0.0f)) return;  // towards the eye
  const glm::vec2 way = along / length, aside(-way.y, way.x);
  const glm::vec2 neck = arrow.to - head * way;
  drawSegment(picture, arrow.from, neck, arrow.width + 2.0f * rim, ink);
  const float half = 0.5f * kHeadWidth * arrow.width * (head / (kHeadLength * arrow.width));
  fillTriangle(picture, arrow.to + 2.0f * rim * way, neck + (half + 1.5f * rim) * aside - rim * way,
               neck - (half + 1.5f * rim) * aside - rim * way, ink);
}

}  // namespace

sim::Colour colourOfWay(sim::Vec3 way) {
  const sim::Vec3f share(way * way);
  return share.x * kAxes[0] + share.y * kAxes[1] + share.z * kAxes[2];
}

void drawArrows(Image& picture, const std::vector<SpaceArrow>& arrows, const Camera& camera, double width_m) {
  const Projection projection(camera, picture.width, picture.height);
  const double near_m = 1e-3 * glm::length(camera.target_m - camera.eye_m);
  std::vector<Seen> seen;
  for (const SpaceArrow& arrow : arrows) {
    if (!(projection.depth_m(arrow.from_m) > near_m) || !(projection.depth_m(arrow.to_m) > near_m)) continue;
    const double depth = projection.depth_m(0.5 * (arrow.from_m + arrow.to_m));
    const sim::Vec3 along = arrow.to_m - arrow.from_m;
    const double length = glm::length(along);
    if (length == 0.0) continue;
    seen.push_back({projection.pixel(arrow.from_m), projection.pixel(arrow.to_m), depth,
                    std::max(0.8f, static_cast<float>(width_m * projection.pixelsAt(depth))),
                    colourOfWay(along / length), arrow.hidden});
  }
  if (seen.empty()) return;
  std::stable_sort(seen.begin(), seen.end(),
                   [](const Seen& a, const Seen& b) { return a.depth_m > b.depth_m; });
  const double farthest = seen.front().depth_m, range = std::max(farthest - seen.back().depth_m, 1e-12);
  for (const Seen& arrow : seen) {
    const float far = static_cast<float>(1.0 - (farthest - arrow.depth_m) / range);
    const float opacity = arrow.hidden ? kHidden : 1.0f;
    if (!arrow.hidden) drawOne(picture, arrow, {kRim, 0.8f}, std::max(0.6f, 0.25f * arrow.width));
    drawOne(picture, arrow, {glm::mix(arrow.colour, kRim, kFarHaze * far), opacity}, 0.0f);
  }
}

}  // namespace espalier::render
