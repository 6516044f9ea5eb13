#include "rules/diffusion/beside.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>

namespace espalier::rules {
namespace {

using Point = glm::dvec2;

constexpr double kLeastShare = 1.0 / 3.0;  // of the shorter edge, that runs along the other

/// Lengths this small are none, of outlines as large as this.
double slackOf(const Outline& outline) {
  double perimeter = 0.0;
  for (std::size_t i = 0; i < outline.size(); ++i)
    perimeter += glm::length(outline[(i + 1) % outline.size()] - outline[i]);
  return 1e-7 * perimeter;
}

/// The turn that takes one direction to another.
Point turnTo(Point from, Point to) {
  return {glm::dot(from, to), from.x * to.y - from.y * to.x};
}

/// An outline with an edge laid along +x from the origin.
Outline onEdge(const Outline& outline, std::size_t edge) {
  const Point from = outline[edge], to = outline[(edge + 1) % outline.size()];
  const Point turn = turnTo(glm::normalize(to - from), {1.0, 0.0});
  const Outline turned = moved(outline, turn, Point(0.0));
  return moved(turned, {1.0, 0.0}, -turned[edge]);
}

/// A place along an edge that nothing keeps it from; it may be one of the ends of what is blocked.
bool open(double t, const std::vector<Stretch>& blocked, double slack) {
  return std::none_of(blocked.begin(), blocked.end(),
                      [&](const Stretch& s) { return t > s.from + slack && t < s.to - slack; });
}

}  // namespace

std::vector<std::size_t> distinctEdges(const Outline& outline) {
  std::vector<std::size_t> edges;
  if (outline.size() < 3) return edges;
  const double slack = 1e3 * slackOf(outline);
  for (std::size_t i = 0; i < outline.size(); ++i) {
    const Outline mine = onEdge(outline, i);
    const auto same = [&](std::size_t k) {
      const Outline other = onEdge(outline, k);
      for (std::size_t c = 0; c < mine.size(); ++c) {
        const Point a = mine[(i + c) % mine.size()], b = other[(k + c) % other.size()];
        if (glm::length(a - b) > slack) return false;
      }
      return true;
    };
    if (std::none_of(edges.begin(), edges.end(), same)) edges.push_back(i);
  }
  return edges;
}

std::vector<Laid> placesBeside(const Outline& parent, const Outline& own, std::span<const std::size_t> edges,
                               double gap, std::span<const Outline> others, Point askew) {
  std::vector<Laid> places;
  if (parent.size() < 3 || own.size() < 3) return places;
  const double slack = slackOf(own);
  const Outline wide = gap > 0.0 ? widened(own, gap - slack) : own;
  double rim = 0.0;
  for (std::size_t i = 0; i < own.size(); ++i) rim += glm::length(own[(i + 1) % own.size()] - own[i]);
  std::vector<Stretch> blocked;
  std::vector<double> stops;
  for (std::size_t e = 0; e < parent.size(); ++e) {
    const Point from = parent[e], to = parent[(e + 1) % parent.size()];
    const double length = glm::length(to - from);
    const Point way = (to - from) / length, out(way.y, -way.x);
    for (const std::size_t f : edges) {
      const Point mine = own[(f + 1) % own.size()] - own[f];
      const Point flush = turnTo(mine / glm::length(mine), -way);
      const Point turn(flush.x * askew.x - flush.y * askew.y, flush.y * askew.x + flush.x * askew.y);
      const Outline turned = moved(own, turn, Point(0.0));
      // What is widened touches the other's edge, so that a corner that points there has its room too.
      const Outline turned_wide = moved(wide, turn, Point(0.0));
      double near = std::numeric_limits<double>::infinity(), near_wide = near, low = near, high = -near;
      for (const Point p : turned_wide) near_wide = std::min(near_wide, glm::dot(p, out));
      for (const Point p : turned) near = std::min(near, glm::dot(p, out));
      for (const Point p : turned) {  // its edge there, or its corner
        if (glm::dot(p, out) > near + 10.0 * slack) continue;
        low = std::min(low, glm::dot(p, way));
        high = std::max(high, glm::dot(p, way));
      }
      const double rim_at = glm::dot(to, out) + (gap > 0.0 ? slack : 0.0);
      const Point by = (rim_at - near_wide) * out + (glm::dot(to, way) - high) * way;
      const double my_length = high - low;
      const double shared = kLeastShare * std::min(length, my_length);
      const double first = shared - length, last = my_length - shared;
      const Outline moving = moved(wide, turn, by);
      blocked.clear();
      stops = {0.0, my_length - length};
      for (const Outline& other : others) {
        const auto stretch = overlaps(moving, way, other, slack);
        if (!stretch || stretch->to <= first || stretch->from >= last) continue;
        blocked.push_back(*stretch);
        stops.insert(stops.end(), {stretch->from, stretch->to});
      }
      std::sort(stops.begin(), stops.end());
      double before = first - 1.0;
      for (const double t : stops) {
        if (t < first || t > last || t - before < 10.0 * slack || !open(t, blocked, slack)) continue;
        before = t;
        Laid laid{turn, by + t * way, 0.0};
        laid.contact = contact(moved(own, laid.turn, laid.by), others, gap, 20.0 * slack) / rim;
        places.push_back(laid);
      }
    }
  }
  return places;
}

}  // namespace espalier::rules
