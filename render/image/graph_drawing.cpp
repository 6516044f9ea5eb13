#include "render/image/graph_drawing.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace espalier::render {
namespace {

constexpr sim::Colour kNode(0.80f, 0.12f, 0.10f), kWaiting(0.13f, 0.36f, 0.74f), kEnded(0.76f, 0.81f, 0.87f),
    kEdge(0.15f, 0.13f, 0.12f);
/// What is farthest is mixed with the rim's colour so far.
constexpr float kHaze = 0.42f;
constexpr float kFaintly = 0.45f;     // of attractors beside a graph
constexpr float kLeastRimmed = 4.0f;  // pixels: a smaller disc is not told from another by a rim

/// A line in space, or where both ends are one place, a disc.
struct Mark {
  sim::Vec3 a_m{0.0}, b_m{0.0};
  double width_m = 0.0;
  sim::Colour colour{0.0f};
  float opacity = 1.0f;
  float least_px = 1.0f;
  bool rim = false;
};

Mark disc(const SpacePoint& point, double diameter_m, sim::Colour colour, float least_px = 1.0f) {
  return {point.at_m, point.at_m, diameter_m, colour, point.hidden ? kHidden : 1.0f, least_px, !point.hidden};
}

/// How near to the eye a line may come before the rest of it is cut off.
double nearestOf(const Camera& camera) {
  return 1e-3 * glm::length(camera.target_m - camera.eye_m);
}

/// Cuts off what is nearer to the eye than `near_m`. False where nothing is left.
bool clip(Mark& mark, const Projection& projection, double near_m) {
  const double a = projection.depth_m(mark.a_m), b = projection.depth_m(mark.b_m);
  if (!(a > near_m) && !(b > near_m)) return false;
  if (a > near_m && b > near_m) return true;
  const sim::Vec3 cut = mark.a_m + (near_m - a) / (b - a) * (mark.b_m - mark.a_m);
  (a > near_m ? mark.b_m : mark.a_m) = cut;
  return true;
}

/// From the farthest to the nearest, by where they begin as balls and rods; of equally far ones the first is
/// drawn first.
void drawMarks(Image& picture, std::vector<Mark> marks, const Camera& camera, const GraphSizes& sizes) {
  const Projection projection(camera, picture.width, picture.height);
  std::erase_if(marks,
                [&, near_m = nearestOf(camera)](Mark& mark) { return !clip(mark, projection, near_m); });
  std::vector<double> depth(marks.size()), begins(marks.size());
  for (std::size_t i = 0; i < marks.size(); ++i) {
    depth[i] = projection.depth_m(0.5 * (marks[i].a_m + marks[i].b_m));
    begins[i] = depth[i] - 0.5 * marks[i].width_m;
  }
  std::vector<std::size_t> order(marks.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t i, std::size_t j) { return begins[i] > begins[j]; });
  const double range = std::max(sizes.farthest_m - sizes.nearest_m, 1e-12);
  for (const std::size_t i : order) {
    const Mark& mark = marks[i];
    const float width =
        std::max(mark.least_px, static_cast<float>(mark.width_m * projection.pixelsAt(depth[i])));
    const float far = static_cast<float>(std::clamp((depth[i] - sizes.nearest_m) / range, 0.0, 1.0));
    const glm::vec2 a = projection.pixel(mark.a_m), b = projection.pixel(mark.b_m);
    if (mark.rim && width >= kLeastRimmed)
      drawSegment(picture, a, b, width + std::max(1.0f, 0.18f * width), {kRim, 0.8f * mark.opacity});
    drawSegment(picture, a, b, width, {glm::mix(mark.colour, kRim, kHaze * far), mark.opacity});
  }
}

/// Of each node, how many ends its branch has.
std::vector<std::uint32_t> endsOf(std::span<const SpaceNode> nodes) {
  std::vector<std::uint32_t> ends(nodes.size(), 0);
  for (std::size_t i = nodes.size(); i-- > 0;) {
    ends[i] = std::max(ends[i], 1u);
    if (nodes[i].parent >= 0) ends[static_cast<std::size_t>(nodes[i].parent)] += ends[i];
  }
  return ends;
}

double timesATwig(std::uint32_t ends) {
  return std::cbrt(static_cast<double>(ends));
}

double middleOf(std::vector<double>& values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

}  // namespace

GraphColours graphColours() {
  return {kNode, kWaiting, kEnded, kEdge};
}

GraphSizes sizesFor(const PointGraph& all, const Camera& camera, int width_px, int height_px) {
  const Projection projection(camera, width_px, height_px);
  std::vector<double> depths, edges;
  const glm::vec2 last(static_cast<float>(width_px), static_cast<float>(height_px));
  glm::vec2 low = last, high(0.0f);
  const auto look = [&](const SpacePoint& point) {
    const double depth = projection.depth_m(point.at_m);
    if (!(depth > nearestOf(camera))) return;
    const glm::vec2 at = projection.pixel(point.at_m);
    if (at != glm::clamp(at, glm::vec2(0.0f), last)) return;
    depths.push_back(depth);
    low = glm::min(low, at);
    high = glm::max(high, at);
  };
  for (const SpaceNode& node : all.nodes) {
    look(node.point);
    if (node.parent >= 0)
      edges.push_back(
          glm::length(node.point.at_m - all.nodes[static_cast<std::size_t>(node.parent)].point.at_m));
  }
  for (const auto* points : {&all.waiting, &all.ended}) std::for_each(points->begin(), points->end(), look);
  if (depths.empty()) return {};

  GraphSizes sizes;
  sizes.nearest_m = *std::min_element(depths.begin(), depths.end());
  sizes.farthest_m = *std::max_element(depths.begin(), depths.end());
  const double count = static_cast<double>(depths.size());
  const double pixels = projection.pixelsAt(middleOf(depths));
  const double height = height_px;
  const glm::dvec2 extent = glm::max(high - low, glm::vec2(1.0f));
  const double apart = std::sqrt(extent.x * extent.y / count);
  sizes.point_m = std::clamp(0.5 * apart, 1.5, std::max(1.5, height / 130.0)) / pixels;
  sizes.twig_m = std::clamp(0.13 * apart, 0.5, std::max(0.5, height / 640.0)) / pixels;
  if (!edges.empty()) {
    const double node = std::min({0.4 * middleOf(edges), 0.4 * apart / pixels, height / 230.0 / pixels});
    if (node > 1.8 * sizes.twig_m && node * pixels > 1.5) sizes.node_m = node;
  }
  const auto ends = endsOf(all.nodes);
  const double root = ends.empty() ? 0.0 : timesATwig(*std::max_element(ends.begin(), ends.end()));
  sizes.start_m = std::max({height / 80.0 / pixels, 1.6 * root * sizes.twig_m, 1.5 * sizes.point_m});
  return sizes;
}

void drawPoints(Image& picture, const PointGraph& graph, const Camera& camera, const GraphSizes& sizes) {
  std::vector<Mark> marks;
  for (const SpacePoint& point : graph.ended) marks.push_back(disc(point, 0.8 * sizes.point_m, kEnded));
  drawMarks(picture, std::move(marks), camera, sizes);
  marks = {};
  for (const SpacePoint& point : graph.waiting) marks.push_back(disc(point, sizes.point_m, kWaiting));
  for (const SpaceNode& node : graph.nodes)
    marks.push_back(disc(node.point,
                         node.parent < 0 ? std::max(0.6 * sizes.start_m, 1.5 * sizes.point_m) : sizes.point_m,
                         kNode));
  drawMarks(picture, std::move(marks), camera, sizes);
}

void drawGraph(Image& picture, const PointGraph& graph, const Camera& camera, const GraphSizes& sizes) {
  std::vector<Mark> marks;
  for (const SpacePoint& point : graph.waiting) {
    marks.push_back(disc(point, 0.8 * sizes.point_m, kWaiting));
    marks.back().opacity *= kFaintly;
    marks.back().rim = false;
  }
  const auto ends = endsOf(graph.nodes);
  for (std::size_t i = 0; i < graph.nodes.size(); ++i) {
    const SpaceNode& node = graph.nodes[i];
    if (node.parent < 0) {
      marks.push_back(disc(node.point, sizes.start_m, kNode));
      continue;
    }
    const SpaceNode& parent = graph.nodes[static_cast<std::size_t>(node.parent)];
    const double width_m = timesATwig(ends[i]) * sizes.twig_m;
    const bool hidden = node.point.hidden && parent.point.hidden;
    marks.push_back(
        {parent.point.at_m, node.point.at_m, width_m, kEdge, hidden ? kHidden : 1.0f, 0.5f, false});
    // A dot on a limb as wide as itself would look like a hole in it.
    if (sizes.node_m > 1.6 * width_m) {
      marks.push_back(disc(node.point, sizes.node_m, kNode));
      marks.back().rim = false;
    }
  }
  drawMarks(picture, std::move(marks), camera, sizes);
}

}  // namespace espalier::render
