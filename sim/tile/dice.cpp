#include "sim/tile/dice.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "sim/tile/clip.h"

namespace espalier::sim {
namespace {

struct Extent {
  double low, high;
};

Extent extentOf(const CutPolygon& polygon, int axis) {
  Extent extent{polygon.corner[0][axis], polygon.corner[0][axis]};
  for (std::size_t i = 1; i < polygon.count; ++i) {
    extent.low = std::min(extent.low, polygon.corner[i][axis]);
    extent.high = std::max(extent.high, polygon.corner[i][axis]);
  }
  return extent;
}

/// What of a polygon lies within the world along an axis; the rest of it is handed over.
template <class Take>
CutPolygon within(const CutPolygon& polygon, int axis, int size, Take beyond) {
  CutPolygon rest = polygon;
  for (const auto& [plane, sign] : {std::pair{-0.5, 1.0}, std::pair{size - 0.5, -1.0}}) {
    if (rest.count == 0) return rest;
    const Extent extent = extentOf(rest, axis);
    if (sign * ((sign > 0 ? extent.low : extent.high) - plane) >= 0.0) continue;
    const CutPolygon outside = cut(rest, axis, plane, -sign);
    if (outside.count > 2) beyond(outside);
    rest = cut(rest, axis, plane, sign);
  }
  return rest;
}

/// Hands over a polygon's part in each of the world's cells along an axis. What is left goes on from cut to
/// cut, so that edges between cells have the corners that both sides of them know.
template <class Take>
void inCells(CutPolygon rest, int axis, int size, Take take) {
  if (rest.count < 3) return;
  const Extent extent = extentOf(rest, axis);
  const auto cell = [&](double place) { return std::clamp(static_cast<int>(place), 0, size - 1); };
  const int first = cell(std::floor(extent.low + 0.5));
  // What merely touches the next plane does not reach behind it.
  const int last = std::max(first, cell(std::ceil(extent.high - 0.5)));
  for (int here = first; here < last; ++here) {
    const double plane = here + 0.5;
    const CutPolygon part = cut(rest, axis, plane, -1.0);
    if (part.count > 2) take(here, part);
    rest = cut(rest, axis, plane, 1.0);
  }
  if (rest.count > 2) take(last, rest);
}

}  // namespace

void dice(const std::array<Vec3, 3>& triangle_vx, Voxel size,
          const std::function<void(Voxel, std::span<const Vec3>)>& visit) {
  const auto beyond = [&](const CutPolygon& polygon) {
    Vec3 middle(0.0);
    for (std::size_t i = 0; i < polygon.count; ++i) middle += polygon.corner[i];
    middle /= static_cast<double>(polygon.count);
    visit(Voxel(glm::clamp(glm::floor(middle + 0.5), Vec3(0.0), Vec3(size - 1))),
          {polygon.corner.data(), polygon.count});
  };
  CutPolygon inside;
  for (const Vec3& corner : triangle_vx) inside.add(corner);
  for (int axis = 0; axis < 3; ++axis) inside = within(inside, axis, size[axis], beyond);
  inCells(inside, 0, size.x, [&](int x, const CutPolygon& slab) {
    inCells(slab, 1, size.y, [&](int y, const CutPolygon& row) {
      inCells(row, 2, size.z, [&](int z, const CutPolygon& piece) {
        visit({x, y, z}, {piece.corner.data(), piece.count});
      });
    });
  });
}

}  // namespace espalier::sim
