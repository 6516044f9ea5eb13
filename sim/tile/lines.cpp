#include "sim/tile/lines.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "sim/base/parallel.h"
#include "sim/base/stop.h"
#include "sim/tile/triangle_rows.h"

namespace espalier::sim {
namespace {

/// Whether a point moved by (e, e^2, e^3) along the world's axes goes the way of a linear form of the sheared
/// coordinates.
bool movedAlong(const LineDirection& d, glm::i64vec3 form) {
  glm::i64vec3 of_axis;
  of_axis[d.axis] = form.x - d.a * form.y - d.b * form.z;
  of_axis[(d.axis + 1) % 3] = form.y;
  of_axis[(d.axis + 2) % 3] = form.z;
  for (int axis = 0; axis < 3; ++axis) {
    if (of_axis[axis] != 0) return of_axis[axis] > 0;
  }
  return false;
}

/// The lines that go through the projected triangle: outerEdges' counterpart for points instead of cubes.
std::array<HalfPlane, 3> innerEdges(const LineDirection& d, glm::i64vec2 p, glm::i64vec2 q, glm::i64vec2 r,
                                    bool anticlockwise) {
  if (!anticlockwise) std::swap(q, r);
  const auto edge = [&](glm::i64vec2 from, glm::i64vec2 to) {
    const glm::i64vec2 out{to.y - from.y, from.x - to.x};
    const bool moved_out = movedAlong(d, {0, out.x, out.y});
    return HalfPlane{out.x, out.y, (out.x * from.x + out.y * from.y - (moved_out ? 1 : 0)) >> 12};
  };
  return {edge(p, q), edge(q, r), edge(r, p)};
}

}  // namespace

Lines::Lines(LineDirection direction, const VoxelBox& box) : direction_(direction) {
  first_ = Voxel(std::numeric_limits<int>::max());
  last_ = Voxel(std::numeric_limits<int>::min());
  for (int corner = 0; corner < 8; ++corner) {
    const Voxel p((corner & 1) != 0 ? box.last.x : box.first.x, (corner & 2) != 0 ? box.last.y : box.first.y,
                  (corner & 4) != 0 ? box.last.z : box.first.z);
    first_ = glm::min(first_, direction.sheared(p));
    last_ = glm::max(last_, direction.sheared(p));
  }
}

std::size_t Lines::count() const {
  return static_cast<std::size_t>(last_.y - first_.y + 1) * static_cast<std::size_t>(last_.z - first_.z + 1);
}

void Lines::cross(const std::array<Vec3, 3>& triangle_vx, std::vector<Crossing>& crossings) const {
  std::array<Fixed, 3> q;
  for (std::size_t i = 0; i < 3; ++i) q[i] = direction_.sheared(fixedFromVoxel(triangle_vx[i]));
  const std::int64_t low = std::min({q[0].y, q[1].y, q[2].y});
  const std::int64_t high = std::max({q[0].y, q[1].y, q[2].y});
  const int first = std::max(cellOf(low), first_.y), last = std::min(cellOf(high), last_.y);
  if (first > last) return;
  // The sheared coordinates reach 2^27 and their normal 2^57.
  const glm::i64vec3 n = normalOf(q);
  if (n.x == 0) return;
  const auto edges = innerEdges(direction_, {q[0].y, q[0].z}, {q[1].y, q[1].z}, {q[2].y, q[2].z}, n.x > 0);
  const bool before_its_plane = movedAlong(direction_, n) != (n.x > 0);
  const Int128 outside_low = (first_.x - 1) * kFixedOne, outside_high = (last_.x + 1) * kFixedOne + 1;
  for (int v = first; v <= last; ++v) {
    IntRange ws{first_.z, last_.z};
    for (const HalfPlane& e : edges) keepAtMost<std::int64_t>(ws, e.b, e.limit - e.a * v);
    for (int w = ws.first; w <= ws.last; ++w) {
      const Int128 along = Int128{n.x} * q[0].x - Int128{n.y} * (v * kFixedOne - q[0].y) -
                           Int128{n.z} * (w * kFixedOne - q[0].z);
      Int128 upwards = -floorDiv<Int128>(n.x > 0 ? -along : along, std::abs(n.x));
      const bool at_a_centre = upwards % kFixedOne == 0 && upwards * n.x == along;
      if (at_a_centre && before_its_plane) ++upwards;
      const Int128 at = std::clamp<Int128>(upwards, outside_low, outside_high);
      crossings.push_back({line(v, w), static_cast<std::int32_t>(at), n.x > 0 ? 1 : -1});
    }
  }
}

void Lines::forEachCrossed(const Triangles& triangles_vx,
                           const std::function<void(std::uint32_t, std::span<const Crossing>)>& work) const {
  constexpr std::size_t kChunk = 1024;
  std::vector<std::vector<Crossing>> chunks((triangles_vx.size() + kChunk - 1) / kChunk);
  parallelForEach(chunks.size(), [&](std::size_t c) {
    const std::size_t last = std::min((c + 1) * kChunk, triangles_vx.size());
    for (std::size_t i = c * kChunk; i < last; ++i) cross(triangles_vx[i], chunks[c]);
  });
  std::vector<std::size_t> end(count() + 1, 0);  // of each line's crossings, once they are sorted by line
  for (const auto& chunk : chunks) {
    throwIfStopped();
    for (const Crossing& c : chunk) ++end[c.line + 1];
  }
  for (std::size_t i = 1; i < end.size(); ++i) end[i] += end[i - 1];
  std::vector<Crossing> crossings(end.back());
  for (auto& chunk : chunks) {
    throwIfStopped();
    for (const Crossing& c : chunk) crossings[end[c.line]++] = c;
    chunk = {};
  }
  parallelFor(count(), [&](std::size_t first_line, std::size_t last_line) {
    for (std::size_t line = first_line; line < last_line; ++line) {
      const std::size_t from = line == 0 ? 0 : end[line - 1];
      if (from == end[line]) continue;
      const std::span mine(crossings.data() + from, end[line] - from);
      std::sort(mine.begin(), mine.end(), [](const Crossing& a, const Crossing& b) { return a.at < b.at; });
      work(static_cast<std::uint32_t>(line), mine);
    }
  });
}

}  // namespace espalier::sim
