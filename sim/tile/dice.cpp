#include "sim/tile/dice.h"

#include <algorithm>
#include <cmath>

#include "sim/tile/clip.h"

namespace espalier::sim {
namespace {

/// The cells along an axis that a polygon lies in, -1 and `size` for what is before and behind the world.
struct Cells {
  int first, last;
};

Cells cellsOf(const CutPolygon& polygon, int axis, int size) {
  double low = polygon.corner[0][axis], high = low;
  for (std::size_t i = 1; i < polygon.count; ++i) {
    low = std::min(low, polygon.corner[i][axis]);
    high = std::max(high, polygon.corner[i][axis]);
  }
  const auto cell = [&](double place) {
    return static_cast<int>(std::clamp(place, -1.0, static_cast<double>(size)));
  };
  const int first = cell(std::floor(low + 0.5));
  // What merely touches the next plane does not reach behind it.
  return {first, std::max(first, cell(std::ceil(high - 0.5)))};
}

/// Hands over a polygon's part in each cell along an axis. What is left goes on from cut to cut, so that
/// edges between cells have the corners that both sides of them know.
template <class Take>
void inCells(CutPolygon rest, int axis, int size, Take take) {
  const Cells cells = cellsOf(rest, axis, size);
  for (int cell = cells.first; cell < cells.last; ++cell) {
    const double plane = cell + 0.5;
    const CutPolygon here = cut(rest, axis, plane, -1.0);
    if (here.count > 2) take(cell, here);
    rest = cut(rest, axis, plane, 1.0);
  }
  if (rest.count > 2) take(cells.last, rest);
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
  const auto inside = [&](int cell, int axis) { return cell >= 0 && cell < size[axis]; };
  CutPolygon whole;
  for (const Vec3& corner : triangle_vx) whole.add(corner);
  inCells(whole, 0, size.x, [&](int x, const CutPolygon& slab) {
    if (!inside(x, 0)) return beyond(slab);
    inCells(slab, 1, size.y, [&](int y, const CutPolygon& row) {
      if (!inside(y, 1)) return beyond(row);
      inCells(row, 2, size.z, [&](int z, const CutPolygon& piece) {
        if (!inside(z, 2)) return beyond(piece);
        visit({x, y, z}, {piece.corner.data(), piece.count});
      });
    });
  });
}

}  // namespace espalier::sim
