#include "rules/growth/surface_points.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <deque>
#include <numeric>
#include <unordered_map>

#include "rules/growth/elements.h"
#include "sim/base/random.h"
#include "sim/tile/clip.h"

namespace espalier::rules {
namespace {

constexpr double kCell_vx = 2.0;
constexpr double kClosest_vx = 0.25;  // between points, about

constexpr const char *kAt = "surface_at_vx", *kArea = "surface_area_vx2", *kCell = "surface_cell",
                     *kCovered = "surface_covered";

std::int64_t keyOf(glm::ivec3 cell) {
  constexpr std::int64_t kMiddle = 1 << 20;
  return ((cell.y + kMiddle) << 42) | ((cell.z + kMiddle) << 21) | (cell.x + kMiddle);
}
std::int64_t cellAt(sim::Vec3 at_vx) {
  return keyOf(glm::ivec3(glm::floor(at_vx / kCell_vx)));
}

/// visit(number) for each point in the cells that a box about a place touches.
template <typename Visit>
void about(const std::vector<std::int64_t>& cells, sim::Vec3 at_vx, double reach_vx, Visit visit) {
  const glm::ivec3 low(glm::floor((at_vx - reach_vx) / kCell_vx)),
      high(glm::floor((at_vx + reach_vx) / kCell_vx));
  for (int y = low.y; y <= high.y; ++y) {
    for (int z = low.z; z <= high.z; ++z) {
      // Along x keys follow each other.
      const auto from = std::lower_bound(cells.begin(), cells.end(), keyOf({low.x, y, z}));
      const auto to = std::upper_bound(from, cells.end(), keyOf({high.x, y, z}));
      for (auto i = from; i != to; ++i) visit(static_cast<std::size_t>(i - cells.begin()));
    }
  }
}

struct Point {
  sim::Vec3 at_vx{0.0};
  sim::Vec3 normal{0.0};  ///< as the triangle is wound
  double area_vx2 = 0.0;
};

/// A piece of a triangle that lies in the world.
struct Piece {
  std::array<sim::Vec3, 3> corners_vx;
  sim::Vec3 normal{0.0};
  double area_vx2 = 0.0;
};

/// Of all triangles that bear something.
std::vector<Piece> piecesInWorld(const sim::SceneSurface& surface, const RuleSet& rules, sim::Voxel size) {
  std::vector<bool> bears;
  for (const std::string& region : surface.regions()) bears.push_back(setNear(rules, region) != nullptr);
  std::vector<Piece> pieces;
  for (const sim::SceneSurface::Triangle& triangle : surface.triangles()) {
    if (!bears[triangle.region]) continue;
    const sim::CutPolygon part = sim::cutToBox(triangle.corners_vx, sim::Vec3(-0.5), sim::Vec3(size) - 0.5);
    for (std::size_t i = 2; i < part.count; ++i) {
      const std::array<sim::Vec3, 3> c{part.corner[0], part.corner[i - 1], part.corner[i]};
      const double area = 0.5 * glm::length(glm::cross(c[1] - c[0], c[2] - c[0]));
      if (area > 0.0) pieces.push_back({c, triangle.normal, area});
    }
  }
  return pieces;
}

/// Evenly on all of them, by Roberts' R2 sequence in each, folded over its diagonal.
std::vector<Point> spread(const std::vector<Piece>& pieces, double most_points) {
  double sum = 0.0;
  for (const Piece& piece : pieces) sum += piece.area_vx2;
  const double own = std::max(kClosest_vx * kClosest_vx, sum / most_points);
  std::vector<Point> points;
  for (const Piece& piece : pieces) {
    const auto& c = piece.corners_vx;
    const auto count = static_cast<std::size_t>(std::max(1.0, std::ceil(piece.area_vx2 / own)));
    for (std::size_t i = 1; i <= count; ++i) {
      double u = std::fmod(0.5 + 0.7548776662466927 * static_cast<double>(i), 1.0);
      double v = std::fmod(0.5 + 0.5698402909980532 * static_cast<double>(i), 1.0);
      if (u + v > 1.0) {
        u = 1.0 - u;
        v = 1.0 - v;
      }
      points.push_back({c[0] + u * (c[1] - c[0]) + v * (c[2] - c[0]), piece.normal,
                        piece.area_vx2 / static_cast<double>(count)});
    }
  }
  return points;
}

bool isOpen(const sim::World& world, sim::Vec3 at_vx, sim::Vec3 normal) {
  const sim::Voxel v = sim::voxelAt(openPlace(at_vx, normal));
  return sim::contains(world.frame().size, v) && !isScene(world, v);
}

/// What an element looks like from above.
struct Seen {
  Stance stance;
  Outline outline;
  double reach_vx = 0.0;
};

Seen seenFromAbove(const sim::PlacedElement& element, const LaidKind& kind) {
  Seen seen{stanceOf(element, kind.rule->pose), {}};
  if (kind.flat) {
    seen.outline = outlineAbout(seen.stance, element, kind);
  } else {
    std::vector<glm::dvec2> corners;
    for (const auto& polygon : kind.rule->polygons) {
      for (const sim::Vec3 corner : polygon)
        corners.push_back(seen.stance.seen(sim::placed(element, corner)));
    }
    seen.outline = hullOf(std::move(corners));
  }
  for (const glm::dvec2 p : seen.outline) seen.reach_vx = std::max(seen.reach_vx, glm::length(p));
  return seen;
}

double coverOf(const sim::PlacedElement& element, const LaidKind& kind, double off_vx,
               const std::vector<std::int64_t>& cells, const std::vector<sim::Vec3>& at_vx,
               const std::vector<double>& area_vx2, std::vector<std::int32_t>& covered) {
  const Seen seen = seenFromAbove(element, kind);
  const double high_vx = off_vx + 1.0;
  double fresh = 0.0;
  about(cells, seen.stance.at_vx, seen.reach_vx + high_vx, [&](std::size_t i) {
    if (covered[i] != 0) return;
    const double height = glm::dot(at_vx[i] - seen.stance.at_vx, seen.stance.normal);
    if (std::abs(height) > high_vx || !covers(seen.outline, seen.stance.seen(at_vx[i]))) return;
    covered[i] = 1;
    fresh += area_vx2[i];
  });
  return fresh;
}

}  // namespace

double SurfacePoints::area() const {
  return std::accumulate(area_vx2.begin(), area_vx2.end(), 0.0);
}

double SurfacePoints::coveredArea() const {
  double sum = 0.0;
  for (std::size_t i = 0; i < covered.size(); ++i) sum += covered[i] != 0 ? area_vx2[i] : 0.0;
  return sum;
}

SurfacePoints pointsAround(std::span<const Stance> lying, const sim::SceneSurface& surface,
                           const RuleBook& book, const sim::World& world, double most_points) {
  std::vector<Point> all = spread(piecesInWorld(surface, book.top(), world.frame().size), most_points);
  std::stable_sort(all.begin(), all.end(),
                   [](const Point& a, const Point& b) { return cellAt(a.at_vx) < cellAt(b.at_vx); });
  std::vector<std::int64_t> cells;
  double own = kClosest_vx * kClosest_vx;
  for (const Point& point : all) {
    cells.push_back(cellAt(point.at_vx));
    own = std::max(own, point.area_vx2);
  }
  // Whose side of the surface was reached: 1 or -1 along its normal; 0 not yet.
  std::vector<std::int8_t> side(all.size(), 0);
  std::deque<std::size_t> reached;
  const double reach_vx = std::max(0.75, 2.0 * std::sqrt(own));
  const double cos_bend = sim::unitCircle(widestBend(book) / 360.0).x - 1e-6;
  const auto reachFrom = [&](sim::Vec3 at_vx, sim::Vec3 normal) {
    about(cells, at_vx, reach_vx, [&](std::size_t i) {
      if (side[i] != 0 || glm::distance(all[i].at_vx, at_vx) > reach_vx) return;
      const double turn = glm::dot(all[i].normal, normal);
      if (std::abs(turn) < cos_bend) return;
      const double out = turn < 0.0 ? -1.0 : 1.0;
      if (!isOpen(world, all[i].at_vx, out * all[i].normal)) return;
      side[i] = static_cast<std::int8_t>(out);
      reached.push_back(i);
    });
  };
  for (const Stance& stance : lying) reachFrom(stance.at_vx, stance.normal);
  while (!reached.empty()) {
    const std::size_t i = reached.front();
    reached.pop_front();
    reachFrom(all[i].at_vx, static_cast<double>(side[i]) * all[i].normal);
  }
  SurfacePoints points;
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (side[i] == 0) continue;
    points.at_vx.push_back(all[i].at_vx);
    points.area_vx2.push_back(all[i].area_vx2);
    points.cell.push_back(cells[i]);
  }
  points.covered.resize(points.at_vx.size());
  return points;
}

double cover(const sim::PlacedElement& element, const LaidKind& kind, double off_vx, SurfacePoints& points) {
  return coverOf(element, kind, off_vx, points.cell, points.at_vx, points.area_vx2, points.covered);
}

void keep(const SurfacePoints& points, sim::Columns& memory) {
  sim::column<sim::Vec3>(memory, kAt) = points.at_vx;
  sim::column<double>(memory, kArea) = points.area_vx2;
  sim::column<std::int64_t>(memory, kCell) = points.cell;
  sim::column<std::int32_t>(memory, kCovered) = points.covered;
}

double coverKept(const sim::PlacedElement& element, const LaidKind& kind, double off_vx,
                 sim::Columns& memory) {
  return coverOf(element, kind, off_vx, sim::column<std::int64_t>(memory, kCell),
                 sim::column<sim::Vec3>(memory, kAt), sim::column<double>(memory, kArea),
                 sim::column<std::int32_t>(memory, kCovered));
}

}  // namespace espalier::rules
