#include "sim/tile/tiling.h"

#include <cassert>
#include <cstdlib>

#include "sim/base/stop.h"
#include "sim/tile/triangle_rows.h"

namespace espalier::sim {
namespace {

std::int64_t rounded(double voxels) {
  [[maybe_unused]] constexpr std::int64_t kReach = std::int64_t{1} << 26;  // a release build asserts nothing
  const double scaled = voxels * static_cast<double>(kFixedOne) + 0.5;
  assert(scaled > -static_cast<double>(kReach) && scaled < static_cast<double>(kReach));
  const auto towards_zero = static_cast<std::int64_t>(scaled);
  return towards_zero - (scaled < static_cast<double>(towards_zero) ? 1 : 0);
}

bool beforeInRows(Voxel a, Voxel b) {
  if (a.y != b.y) return a.y < b.y;
  if (a.z != b.z) return a.z < b.z;
  return a.x < b.x;
}

void sortTail(std::vector<Voxel>& voxels, std::size_t from) {
  std::sort(voxels.begin() + static_cast<std::ptrdiff_t>(from), voxels.end(), beforeInRows);
}

/// Makes one set of two: the voxels from `start` and those from `middle`, each without repeats.
void uniteTail(std::vector<Voxel>& voxels, std::size_t start, std::size_t middle) {
  const auto first = voxels.begin() + static_cast<std::ptrdiff_t>(start);
  const auto added = voxels.begin() + static_cast<std::ptrdiff_t>(middle);
  constexpr std::size_t kFew = 64;  // a leaf's voxels: looking through them is quicker than sorting them
  if (voxels.size() - start <= kFew) {
    const auto known = [&](Voxel v) { return std::find(first, added, v) != added; };
    voxels.erase(std::remove_if(added, voxels.end(), known), voxels.end());
  } else {
    std::sort(first, voxels.end(), beforeInRows);
    voxels.erase(std::unique(first, voxels.end()), voxels.end());
  }
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

}  // namespace

Fixed fixedFromVoxel(Vec3 p_vx) {
  return {rounded(p_vx.x), rounded(p_vx.y), rounded(p_vx.z)};
}

Voxel tilePoint(Vec3 p_vx) {
  return cellOf(cornerFixed(p_vx));
}

void tileSegment(Vec3 a_vx, Vec3 b_vx, std::vector<Voxel>& voxels) {
  walkSegment(cornerFixed(a_vx), cornerFixed(b_vx), voxels);
}

void tileTriangle(const std::array<Vec3, 3>& corners_vx, std::vector<Voxel>& voxels) {
  tileFixed({cornerFixed(corners_vx[0]), cornerFixed(corners_vx[1]), cornerFixed(corners_vx[2])}, voxels);
}

void tilePolygon(const std::vector<Vec3>& corners_vx, std::vector<Voxel>& voxels) {
  assert(corners_vx.size() >= 3);
  const std::size_t start = voxels.size();
  const Fixed hub = cornerFixed(corners_vx[0]);
  Fixed previous = cornerFixed(corners_vx[1]);
  for (std::size_t i = 2; i < corners_vx.size(); ++i) {
    throwIfStopped();
    const Fixed next = cornerFixed(corners_vx[i]);
    const std::size_t known = voxels.size();
    tileFixed({hub, previous, next}, voxels);
    uniteTail(voxels, start, known);
    previous = next;
  }
}

}  // namespace espalier::sim
