#include "rules/diffusion/outline.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>

namespace espalier::rules {
namespace {

using Point = glm::dvec2;

double cross(Point a, Point b) {
  return a.x * b.y - a.y * b.x;
}

std::size_t after(const Outline& outline, std::size_t i) {
  return i + 1 < outline.size() ? i + 1 : 0;
}

/// To the right of an edge: out of an outline that runs anticlockwise.
Point outward(Point from, Point to) {
  const Point way = glm::normalize(to - from);
  return {way.y, -way.x};
}

Point nearestOnLine(Point from, Point to, Point at) {
  const Point way = to - from;
  const double length2 = glm::dot(way, way);
  return length2 > 0.0 ? from + std::clamp(glm::dot(at - from, way) / length2, 0.0, 1.0) * way : from;
}

/// Bounds along a way.
Stretch along(const Outline& outline, Point way) {
  Stretch bounds{std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()};
  for (const Point p : outline) {
    bounds.from = std::min(bounds.from, glm::dot(p, way));
    bounds.to = std::max(bounds.to, glm::dot(p, way));
  }
  return bounds;
}

/// What a line at a level across a way cuts out of an outline, along the way.
Stretch chord(const Outline& outline, Point way, Point across, double level) {
  Stretch cut{std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()};
  const auto add = [&](double t) { cut = {std::min(cut.from, t), std::max(cut.to, t)}; };
  for (std::size_t i = 0; i < outline.size(); ++i) {
    const Point p = outline[i], q = outline[after(outline, i)];
    const double hp = glm::dot(p, across) - level, hq = glm::dot(q, across) - level;
    if (hp == 0.0) add(glm::dot(p, way));
    if ((hp < 0.0 && hq > 0.0) || (hp > 0.0 && hq < 0.0)) add(glm::dot(glm::mix(p, q, hp / (hp - hq)), way));
  }
  return cut;
}

/// Whether an edge of `a` keeps two outlines apart.
bool keepsApart(const Outline& a, const Outline& b) {
  for (std::size_t i = 0; i < a.size(); ++i) {
    const Point p = a[i], q = a[after(a, i)];
    if (p == q) continue;
    const Point out = outward(p, q);
    const Stretch mine = along(a, out), other = along(b, out);
    if (other.from >= mine.to) return true;
  }
  return false;
}

}  // namespace

Outline hullOf(std::vector<Point> points) {
  const auto before = [](Point a, Point b) { return a.x < b.x || (a.x == b.x && a.y < b.y); };
  std::sort(points.begin(), points.end(), before);
  points.erase(std::unique(points.begin(), points.end()), points.end());
  if (points.size() < 3) return points;
  Outline hull;
  // Andrew's monotone chain: the lower side, then the upper one.
  for (int side = 0; side < 2; ++side) {
    const std::size_t first = hull.size();
    for (const Point p : points) {
      while (hull.size() >= first + 2 && cross(hull.back() - hull[hull.size() - 2], p - hull.back()) <= 0.0)
        hull.pop_back();
      hull.push_back(p);
    }
    hull.pop_back();
    std::reverse(points.begin(), points.end());
  }
  return hull;
}

double areaOf(const Outline& outline) {
  double twice = 0.0;
  for (std::size_t i = 2; i < outline.size(); ++i)
    twice += cross(outline[i - 1] - outline[0], outline[i] - outline[0]);
  return 0.5 * twice;
}

bool covers(const Outline& outline, Point point) {
  if (outline.size() < 3) return false;
  for (std::size_t i = 0; i < outline.size(); ++i) {
    if (cross(outline[after(outline, i)] - outline[i], point - outline[i]) < 0.0) return false;
  }
  return true;
}

Outline widened(const Outline& outline, double by) {
  if (outline.size() == 1) {
    const Point p = outline.front();
    return {p + Point(-by, -by), p + Point(by, -by), p + Point(by, by), p + Point(-by, by)};
  }
  Outline wide;
  for (std::size_t i = 0; i < outline.size(); ++i) {
    const std::size_t last = i > 0 ? i - 1 : outline.size() - 1;
    const Point out = outward(outline[i], outline[after(outline, i)]);
    if (outline.size() == 2) {  // there and back
      const Point way(-out.y, out.x);
      wide.push_back(outline[i] + by * (out - way));
      wide.push_back(outline[after(outline, i)] + by * (out + way));
      continue;
    }
    const Point before = outward(outline[last], outline[i]);
    // Where the two moved lines meet; they never turn back, as the outline is convex.
    wide.push_back(outline[i] + by * (out + before) / std::max(1e-6, 1.0 + glm::dot(out, before)));
  }
  return wide;
}

Outline moved(const Outline& outline, Point turn, Point by) {
  Outline there;
  for (const Point p : outline)
    there.push_back(Point(turn.x * p.x - turn.y * p.y, turn.y * p.x + turn.x * p.y) + by);
  return there;
}

bool overlap(const Outline& a, const Outline& b) {
  return a.size() > 1 && b.size() > 1 && !keepsApart(a, b) && !keepsApart(b, a);
}

double distance(const Outline& a, const Outline& b) {
  if (overlap(a, b) || covers(a, b.front()) || covers(b, a.front())) return 0.0;
  double least = std::numeric_limits<double>::infinity();
  const auto fromCorners = [&](const Outline& corners, const Outline& edges) {
    for (const Point p : corners) {
      for (std::size_t i = 0; i < edges.size(); ++i)
        least = std::min(least, glm::length(nearestOnLine(edges[i], edges[after(edges, i)], p) - p));
    }
  };
  fromCorners(a, b);
  fromCorners(b, a);
  return least;
}

std::optional<Stretch> overlaps(const Outline& moving, Point way, const Outline& other, double slack) {
  const Point across(-way.y, way.x);
  const Stretch mine = along(moving, across), its = along(other, across);
  const double low = std::max(mine.from, its.from), high = std::min(mine.to, its.to);
  // A line along the way, or a point, has one level alone.
  const bool flat = its.to - its.from <= 2.0 * slack;
  if (flat) {
    const double level = 0.5 * (its.from + its.to);
    if (level <= mine.from + slack || level >= mine.to - slack) return std::nullopt;
    const Stretch cut = chord(moving, way, across, level), edge = along(other, way);
    return Stretch{edge.from - cut.to, edge.to - cut.from};
  }
  if (high - low <= 2.0 * slack) return std::nullopt;
  std::optional<Stretch> all;
  const auto at = [&](double level) {
    if (level < low + slack || level > high - slack) return;
    const Stretch cut = chord(moving, way, across, level), edge = chord(other, way, across, level);
    if (cut.from > cut.to || edge.from > edge.to) return;
    const Stretch t{edge.from - cut.to, edge.to - cut.from};
    all = all ? Stretch{std::min(all->from, t.from), std::max(all->to, t.to)} : t;
  };
  at(low + slack);
  at(high - slack);
  for (const Point p : moving) at(glm::dot(p, across));
  for (const Point p : other) at(glm::dot(p, across));
  return all;
}

double contact(const Outline& outline, std::span<const Outline> others, double gap, double slack) {
  double sum = 0.0;
  for (std::size_t i = 0; i < outline.size(); ++i) {
    const Point from = outline[i], to = outline[after(outline, i)];
    const double length = glm::length(to - from);
    if (!(length > 0.0)) continue;
    const Point out = outward(from, to), way(-out.y, out.x);
    for (const Outline& other : others) {
      if (other.size() < 2) continue;
      for (std::size_t k = 0; k < other.size(); ++k) {
        const Point a = other[k] - from, b = other[after(other, k)] - from;
        if (std::abs(glm::dot(a, out) - gap) > slack || std::abs(glm::dot(b, out) - gap) > slack) continue;
        const double low = std::max(0.0, std::min(glm::dot(a, way), glm::dot(b, way)));
        const double high = std::min(length, std::max(glm::dot(a, way), glm::dot(b, way)));
        if (high <= low) continue;
        sum += high - low;
        break;  // a line has two edges in one place
      }
    }
  }
  return sum;
}

}  // namespace espalier::rules
