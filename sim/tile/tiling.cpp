#include "sim/tile/tiling.h"

#include <algorithm>
#include <bit>
#include <cstdlib>

#include "sim/base/stop.h"
#include "sim/tile/triangle_rows.h"

namespace espalier::sim {
namespace {

void sortTail(std::vector<Voxel>& voxels, std::size_t from) {
  std::sort(voxels.begin() + static_cast<std::ptrdiff_t>(from), voxels.end(), beforeInRows);
}

/// One axis of a segment on its way through the planes between voxels.
struct AxisWalk {
  std::int64_t length;    ///< |d|
  std::int64_t to_plane;  ///< distance to the first plane; the crossing's time is to_plane / length
  int step;
  int planes;

  AxisWalk(std::int64_t from, std::int64_t to)
      : length(std::abs(to - from)),
        // An axis that stands still crosses its planes after all others: any positive distance says so.
        to_plane(to > from   ? kFixedOne - (from & (kFixedOne - 1))
                 : to < from ? from & (kFixedOne - 1)
                             : 1),
        step(to > from ? 1 : -1),
        planes(std::abs(cellOf(to) - cellOf(from))) {}
};

/// Negative when a crosses its next plane before b. Where both cross at once, the shift decides: it is larger
/// along the earlier axis, which is thus early where it moves up and late where it moves down.
std::int64_t firstLead(const AxisWalk& a, const AxisWalk& b) {
  return a.to_plane * b.length - b.to_plane * a.length - (a.step > 0 ? 1 : 0);
}

void walkSegment(Fixed a, Fixed b, std::vector<Voxel>& voxels) {
  const AxisWalk x(a.x, b.x);
  const AxisWalk y(a.y, b.y);
  const AxisWalk z(a.z, b.z);
  Voxel v = cellOf(a);
  const std::size_t start = voxels.size();
  const int steps = x.planes + y.planes + z.planes;
  voxels.resize(start + static_cast<std::size_t>(steps) + 1);
  Voxel* out = voxels.data() + start;
  *out++ = v;
  std::int64_t xy = firstLead(x, y);
  std::int64_t xz = firstLead(x, z);
  std::int64_t yz = firstLead(y, z);
  for (int i = 0; i < steps; ++i) {
    if (xy < 0 && xz < 0) {
      v.x += x.step;
      xy += kFixedOne * y.length;
      xz += kFixedOne * z.length;
    } else if (xy >= 0 && yz < 0) {
      v.y += y.step;
      xy -= kFixedOne * x.length;
      yz += kFixedOne * z.length;
    } else {
      v.z += z.step;
      xz -= kFixedOne * x.length;
      yz -= kFixedOne * y.length;
    }
    *out++ = v;
  }
}

/// The triangle has no area: the segment between its two corners that are farthest apart.
void tileFlat(const std::array<Fixed, 3>& q, std::vector<Voxel>& voxels) {
  const auto apart = [](Fixed a, Fixed b) {
    return std::abs(a.x - b.x) + std::abs(a.y - b.y) + std::abs(a.z - b.z);
  };
  std::size_t longest = 0;
  for (std::size_t i = 1; i < 3; ++i) {
    if (apart(q[i], q[(i + 1) % 3]) > apart(q[longest], q[(longest + 1) % 3])) longest = i;
  }
  const std::size_t start = voxels.size();
  walkSegment(q[longest], q[(longest + 1) % 3], voxels);
  sortTail(voxels, start);
}

Fixed cornerFixed(Vec3 p_vx) {
  return fromCorner(fixedFromVoxel(p_vx));
}

void tileFixed(const std::array<Fixed, 3>& q, std::vector<Voxel>& voxels) {
  if (normalOf(q) == glm::i64vec3(0)) return tileFlat(q, voxels);
  constexpr int kAll = 1 << 15;
  forEachTriangleRow(q, Voxel(-kAll), Voxel(kAll), [&](int y, int z, int first, int last) {
    for (int x = first; x <= last; ++x) voxels.emplace_back(x, y, z);
  });
}

/// The corners of triangles, measured from the low corner of voxel (0, 0, 0).
template <typename Visit>
void forEachTriangle(std::span<const glm::ivec3> corners, std::span<const CornerNumbers> triangles,
                     Visit visit) {
  for (const auto& [a, b, c] : triangles) {
    throwIfStopped();
    visit({fromCorner(Fixed(corners[a])), fromCorner(Fixed(corners[b])), fromCorner(Fixed(corners[c]))});
  }
}

}  // namespace

Voxel tilePoint(Vec3 p_vx) {
  return cellOf(cornerFixed(p_vx));
}

void tileSegment(Vec3 a_vx, Vec3 b_vx, std::vector<Voxel>& voxels) {
  walkSegment(cornerFixed(a_vx), cornerFixed(b_vx), voxels);
}

void tileTriangle(const std::array<Vec3, 3>& corners_vx, std::vector<Voxel>& voxels) {
  tileFixed({cornerFixed(corners_vx[0]), cornerFixed(corners_vx[1]), cornerFixed(corners_vx[2])}, voxels);
}

void tileTriangles(std::span<const glm::ivec3> corners, std::span<const CornerNumbers> triangles,
                   std::vector<Voxel>& voxels) {
  using Corners = const std::array<Fixed, 3>&;
  if (triangles.empty()) return;
  glm::ivec3 low = corners[0], high = corners[0];
  for (const glm::ivec3 corner : corners) low = glm::min(low, corner), high = glm::max(high, corner);
  const Voxel first = cellOf(fromCorner(Fixed(low))), span = cellOf(fromCorner(Fixed(high))) - first + 1;
  constexpr int kRows = 256, kWordBits = 64;  // what is small is gathered in bits, row by row
  const std::size_t start = voxels.size();
  if (span.x > kWordBits || std::int64_t{span.y} * span.z > kRows) {
    forEachTriangle(corners, triangles, [&](Corners q) { tileFixed(q, voxels); });
    sortTail(voxels, start);
    voxels.erase(std::unique(voxels.begin() + static_cast<std::ptrdiff_t>(start), voxels.end()),
                 voxels.end());
    return;
  }
  std::array<std::uint64_t, kRows> rows{};
  const auto rowAt = [&](int y, int z) -> std::uint64_t& {
    return rows[static_cast<std::size_t>((y - first.y) * span.z + z - first.z)];
  };
  forEachTriangle(corners, triangles, [&](Corners q) {
    if (normalOf(q) == glm::i64vec3(0)) {
      tileFlat(q, voxels);
      for (; voxels.size() > start; voxels.pop_back())
        rowAt(voxels.back().y, voxels.back().z) |= std::uint64_t{1} << (voxels.back().x - first.x);
      return;
    }
    forEachTriangleRow(q, first, first + span - 1, [&](int y, int z, int from, int to) {
      rowAt(y, z) |= ~std::uint64_t{0} >> (kWordBits - 1 - (to - from)) << (from - first.x);
    });
  });
  for (int y = 0; y < span.y; ++y) {
    for (int z = 0; z < span.z; ++z) {
      for (std::uint64_t left = rows[static_cast<std::size_t>(y * span.z + z)]; left != 0; left &= left - 1)
        voxels.push_back(first + Voxel(std::countr_zero(left), y, z));
    }
  }
}

}  // namespace espalier::sim
