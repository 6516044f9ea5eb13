// Inside or outside by vote. Lines of voxel centres run through the mesh; what is inside follows from their
// crossings with the triangles, found exactly in whole numbers. A crossing exactly through an edge or a
// corner is settled by moving the line by (e, e^2), so that triangles which share an edge are crossed once
// together.
//
// A voxel is judged from both ends of each line: looking to one end, it is inside when the triangles that
// face it and those that turn away do not cancel (the winding number along the line). Solids that overlap
// thus stay full, and meshes that are inside out do no harm. Where the mesh is closed both ends agree; where
// a line leaks through a hole they contradict each other, and the share of ends that say inside, over many
// directions, approaches the generalized winding number (Jacobson, Kavan and Sorkine-Hornung 2013), which is
// above one half where more is walled than open.
//
// Lines along the three axes settle a voxel when all six ends say inside, or one at most does. The others are
// doubtful: the majority of thirteen directions, diagonals included, decides on them, ties for outside.
//
// Voxels lie on one line of each direction, so lines run in parallel and only count into voxels of their own.
#include "sim/fill.h"

#include <algorithm>
#include <cmath>
#include <glm/vector_relational.hpp>
#include <limits>
#include <span>

#include "sim/parallel.h"
#include "sim/triangle_rows.h"

namespace espalier::sim {
namespace {

/// Lattice direction with 1 along `axis` and a, b along the two axes after it. The shear (u, v, w) =
/// (p0, p1 - a p0, p2 - b p0) turns it into the direction u, and the lattice into itself.
struct Direction {
  int axis, a, b;

  template <typename V>
  V sheared(V p) const {
    const auto u = p[axis];
    return {u, p[(axis + 1) % 3] - a * u, p[(axis + 2) % 3] - b * u};
  }
  Voxel voxel(int u, int v, int w) const {
    Voxel p(0);
    p[axis] = u;
    p[(axis + 1) % 3] = v + a * u;
    p[(axis + 2) % 3] = w + b * u;
    return p;
  }
};

constexpr std::array<Direction, 3> kAxes{{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}}};
constexpr std::array<Direction, 10> kDiagonals{{{0, 1, 0},
                                                {0, -1, 0},
                                                {0, 0, 1},
                                                {0, 0, -1},
                                                {1, 1, 0},
                                                {1, -1, 0},
                                                {0, 1, 1},
                                                {0, 1, -1},
                                                {0, -1, 1},
                                                {0, -1, -1}}};

/// The box in which votes are counted.
struct Box {
  Voxel first, last;

  Voxel size() const { return last - first + 1; }
  std::size_t count() const {
    return static_cast<std::size_t>(size().x) * static_cast<std::size_t>(size().y) *
           static_cast<std::size_t>(size().z);
  }
  std::size_t index(Voxel v) const {
    const Voxel p = v - first;
    return (static_cast<std::size_t>(p.y) * static_cast<std::size_t>(size().z) +
            static_cast<std::size_t>(p.z)) *
               static_cast<std::size_t>(size().x) +
           static_cast<std::size_t>(p.x);
  }
};

/// For each voxel of the box, how many ends of lines call it inside.
using Votes = std::vector<std::uint8_t>;

struct Crossing {
  std::uint32_t line;
  std::int32_t before;  ///< the first voxel centre at or after the crossing
  std::int32_t turn;    ///< +1 or -1: which side of the triangle the line comes from
};

/// The lines of one direction that meet a box.
class Lines {
 public:
  Lines(Direction direction, const Box& box) : direction_(direction), box_(box) {
    first_ = Voxel(std::numeric_limits<int>::max());
    last_ = Voxel(std::numeric_limits<int>::min());
    for (int corner = 0; corner < 8; ++corner) {
      const Voxel p((corner & 1) != 0 ? box.last.x : box.first.x,
                    (corner & 2) != 0 ? box.last.y : box.first.y,
                    (corner & 4) != 0 ? box.last.z : box.first.z);
      first_ = glm::min(first_, direction.sheared(p));
      last_ = glm::max(last_, direction.sheared(p));
    }
  }

  std::size_t count() const {
    return static_cast<std::size_t>(last_.y - first_.y + 1) *
           static_cast<std::size_t>(last_.z - first_.z + 1);
  }

  void cross(const std::array<Vec3, 3>& triangle_vx, std::vector<Crossing>& crossings) const {
    std::array<Fixed, 3> q;
    for (std::size_t i = 0; i < 3; ++i) q[i] = direction_.sheared(fixedFromVoxel(triangle_vx[i]));
    // The sheared coordinates reach 2^27 and their normal 2^57.
    const glm::i64vec3 n = normalOf(q);
    if (n.x == 0) return;
    const auto edges = innerEdges({q[0].y, q[0].z}, {q[1].y, q[1].z}, {q[2].y, q[2].z}, n.x > 0);
    const std::int64_t low = std::min({q[0].y, q[1].y, q[2].y});
    const std::int64_t high = std::max({q[0].y, q[1].y, q[2].y});
    const int last = std::min(cellOf(high), last_.y);
    for (int v = std::max(cellOf(low), first_.y); v <= last; ++v) {
      IntRange ws{first_.z, last_.z};
      for (const HalfPlane& e : edges) keepAtMost<std::int64_t>(ws, e.b, e.limit - e.a * v);
      for (int w = ws.first; w <= ws.last; ++w) {
        // The plane is crossed at along / n.x; what counts is the first centre at or after it, rounded up
        // twice.
        const Int128 along = Int128{n.x} * q[0].x - Int128{n.y} * (v * kFixedOne - q[0].y) -
                             Int128{n.z} * (w * kFixedOne - q[0].z);
        const Int128 upwards = -floorDiv<Int128>(n.x > 0 ? -along : along, std::abs(n.x));
        const Int128 before = -floorDiv<Int128>(-upwards, kFixedOne);
        const Int128 clamped = std::clamp<Int128>(before, first_.x, last_.x + 1);
        crossings.push_back({line(v, w), static_cast<std::int32_t>(clamped), n.x > 0 ? 1 : -1});
      }
    }
  }

  /// Counts what both ends of a line say of its voxels.
  void vote(std::uint32_t line, std::span<Crossing> crossings, Votes& votes) const {
    std::sort(crossings.begin(), crossings.end(),
              [](const Crossing& a, const Crossing& b) { return a.before < b.before; });
    int turns_after = 0;
    for (const Crossing& c : crossings) turns_after += c.turn;
    int turns_before = 0;
    int from = first_.x;
    for (std::size_t i = 0; i <= crossings.size(); ++i) {
      const int to = i < crossings.size() ? crossings[i].before : last_.x + 1;
      const int inside = (turns_before != 0 ? 1 : 0) + (turns_after != 0 ? 1 : 0);
      if (inside != 0) mark(line, from, to, static_cast<std::uint8_t>(inside), votes);
      if (i == crossings.size()) break;
      turns_before += crossings[i].turn;
      turns_after -= crossings[i].turn;
      from = to;
    }
  }

 private:
  /// The lines that go through the projected triangle: outerEdges' counterpart for points instead of cubes.
  static std::array<HalfPlane, 3> innerEdges(glm::i64vec2 p, glm::i64vec2 q, glm::i64vec2 r,
                                             bool anticlockwise) {
    if (!anticlockwise) std::swap(q, r);
    const auto edge = [](glm::i64vec2 from, glm::i64vec2 to) {
      const glm::i64vec2 out{to.y - from.y, from.x - to.x};
      const bool moved_out = out.x > 0 || (out.x == 0 && out.y > 0);
      return HalfPlane{out.x, out.y, (out.x * from.x + out.y * from.y - (moved_out ? 1 : 0)) >> 12};
    };
    return {edge(p, q), edge(q, r), edge(r, p)};
  }

  std::uint32_t line(int v, int w) const {
    return static_cast<std::uint32_t>(v - first_.y) * static_cast<std::uint32_t>(last_.z - first_.z + 1) +
           static_cast<std::uint32_t>(w - first_.z);
  }

  void mark(std::uint32_t line, int from, int to, std::uint8_t ends, Votes& votes) const {
    const auto width = static_cast<std::uint32_t>(last_.z - first_.z + 1);
    const int v = static_cast<int>(line / width) + first_.y;
    const int w = static_cast<int>(line % width) + first_.z;
    for (int u = from; u < to; ++u) {
      const Voxel p = direction_.voxel(u, v, w);
      if (!contains(box_.size(), p - box_.first)) continue;
      std::uint8_t& count = votes[box_.index(p)];
      count = static_cast<std::uint8_t>(count + ends);
    }
  }

  Direction direction_;
  Box box_;
  Voxel first_, last_;  ///< in sheared coordinates
};

void countVotes(const std::vector<std::array<Vec3, 3>>& triangles_vx, const Lines& lines, Votes& votes) {
  constexpr std::size_t kChunk = 1024;
  std::vector<std::vector<Crossing>> chunks((triangles_vx.size() + kChunk - 1) / kChunk);
  parallelForEach(chunks.size(), [&](std::size_t c) {
    const std::size_t last = std::min((c + 1) * kChunk, triangles_vx.size());
    for (std::size_t i = c * kChunk; i < last; ++i) lines.cross(triangles_vx[i], chunks[c]);
  });
  std::vector<std::size_t> end(lines.count() + 1,
                               0);  // of each line's crossings, once they are sorted by line
  for (const auto& chunk : chunks) {
    for (const Crossing& c : chunk) ++end[c.line + 1];
  }
  for (std::size_t i = 1; i < end.size(); ++i) end[i] += end[i - 1];
  std::vector<Crossing> crossings(end.back());
  for (const auto& chunk : chunks) {
    for (const Crossing& c : chunk) crossings[end[c.line]++] = c;
  }
  parallelForEach(lines.count(), [&](std::size_t line) {
    const std::size_t from = line == 0 ? 0 : end[line - 1];
    if (from == end[line]) return;
    lines.vote(static_cast<std::uint32_t>(line), {crossings.data() + from, end[line] - from}, votes);
  });
}

/// The voxels of the world that may be inside.
Box boxOf(const std::vector<std::array<Vec3, 3>>& triangles_vx, Voxel size) {
  Box box{size, Voxel(-1)};
  for (const auto& t : triangles_vx) {
    for (const Vec3& p : t) {
      box.first = glm::min(box.first, tilePoint(p));
      box.last = glm::max(box.last, tilePoint(p));
    }
  }
  return {glm::max(box.first, Voxel(0)), glm::min(box.last, size - 1)};
}

}  // namespace

Inside findInside(const std::vector<std::array<Vec3, 3>>& triangles_vx, const BitVolume& surface) {
  Inside result{BitVolume(surface.size()), 0};
  const Box box = boxOf(triangles_vx, surface.size());
  if (glm::any(glm::lessThan(box.size(), Voxel(1)))) return result;
  Votes votes(box.count());
  for (const Direction& d : kAxes) countVotes(triangles_vx, Lines(d, box), votes);

  std::vector<Voxel> doubtful;
  for (int y = box.first.y; y <= box.last.y; ++y) {
    for (int z = box.first.z; z <= box.last.z; ++z) {
      for (int x = box.first.x; x <= box.last.x; ++x) {
        const Voxel v(x, y, z);
        if (surface.at(v)) continue;
        const int inside = votes[box.index(v)];
        if (inside == 2 * static_cast<int>(kAxes.size())) {
          result.voxels.set(v);
        } else if (inside > 1) {
          doubtful.push_back(v);
        }
      }
    }
  }
  if (doubtful.empty()) return result;
  for (const Direction& d : kDiagonals) countVotes(triangles_vx, Lines(d, box), votes);
  constexpr int kHalf = static_cast<int>(kAxes.size() + kDiagonals.size());
  for (const Voxel v : doubtful) {
    if (votes[box.index(v)] > kHalf) result.voxels.set(v);
  }
  result.doubtful = doubtful.size();
  return result;
}

}  // namespace espalier::sim
