// Inside or outside by vote. Lines of voxel centres run through the mesh; what is inside follows from their
// crossings with the triangles (sim/tile/lines.h).
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
// What takes light is thinner than what is tiled. Tiling takes every voxel that a triangle touches, which
// swells a wall by half a voxel on either side and more; shadows would swell with it. Of a solid the voxels
// take light whose centres are inside: as many are too much as too little. Light travels along lines of
// voxels that share faces, so nothing leaks if of any two such neighbours with a triangle between their
// centres one takes light. On an open surface, and where a solid leaves both outside, that is the one behind
// the triangle; where triangles face both ways (a wall thinner than a voxel), the one nearer to them.
//
// Voxels lie on one line of each direction, so lines run in parallel and only write to voxels of their own.
// The box is worked through in slabs, so that its bytes never outgrow the world's bits.
#include "sim/tile/fill.h"

#include <algorithm>
#include <bit>
#include <cstring>
#include <glm/common.hpp>

#include "sim/base/parallel.h"
#include "sim/tile/tiling.h"

namespace espalier::sim {
namespace {

constexpr std::array<LineDirection, 3> kAxes{{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}}};
constexpr std::array<LineDirection, 10> kDiagonals{{{0, 1, 0},
                                                    {0, -1, 0},
                                                    {0, 0, 1},
                                                    {0, 0, -1},
                                                    {1, 1, 0},
                                                    {1, -1, 0},
                                                    {0, 1, 1},
                                                    {0, 1, -1},
                                                    {0, -1, 1},
                                                    {0, -1, -1}}};

/// A byte for each voxel of a box.
using Bytes = std::vector<std::uint8_t>;

/// Adds for each voxel of the box how many ends of its line call it inside.
void vote(const VoxelBox& box, const Lines& lines, std::uint32_t line, std::span<const Crossing> crossings,
          Bytes& votes) {
  int turns_after = 0;
  for (const Crossing& c : crossings) turns_after += c.turn;
  int turns_before = 0;
  int from = lines.first();
  for (std::size_t i = 0; i <= crossings.size(); ++i) {
    const int to = i < crossings.size() ? crossings[i].before() : lines.last() + 1;
    const int inside = (turns_before != 0 ? 1 : 0) + (turns_after != 0 ? 1 : 0);
    for (int u = from; inside != 0 && u < to; ++u) {
      const Voxel v = lines.voxel(line, u);
      if (!box.has(v)) continue;
      std::uint8_t& count = votes[box.index(v)];
      count = static_cast<std::uint8_t>(count + inside);
    }
    if (i == crossings.size()) break;
    turns_before += crossings[i].turn;
    turns_after -= crossings[i].turn;
    from = to;
  }
}

/// Marks of each two neighbours with triangles between their centres the one that takes light if neither is
/// inside: bit 2 axis where the other lies before it, bit 2 axis + 1 where it lies after it.
void markSkin(const VoxelBox& box, const Lines& lines, int axis, std::uint32_t line,
              std::span<const Crossing> crossings, Bytes& skin) {
  for (std::size_t i = 0; i < crossings.size();) {
    int turns = 0;
    std::size_t next = i;
    for (; next < crossings.size() && crossings[next].before() == crossings[i].before(); ++next)
      turns += crossings[next].turn;
    const int after = crossings[i].before();
    const std::int64_t middle = (std::int64_t{crossings[i].at} + crossings[next - 1].at) / 2;
    // Turn -1 is a triangle that faces the oncoming line. Halfway goes to the later one, as tiling has it.
    const bool second = turns != 0 ? turns < 0 : middle - (after - 1) * kFixedOne >= kFixedOne / 2;
    const Voxel v = lines.voxel(line, second ? after : after - 1);
    if (box.has(v)) {
      std::uint8_t& marks = skin[box.index(v)];
      marks = static_cast<std::uint8_t>(marks | 1u << (2 * axis + (second ? 0 : 1)));
    }
    i = next;
  }
}

/// Part of a mesh's box, with a rim of neighbours that are judged but belong to others.
class Slab {
 public:
  /// `known`: the voxels inside; null: there are none, or `solid` says that lines vote on them.
  Slab(const Triangles& triangles_vx, const BitVolume& surface, const VoxelBox& box, bool solid,
       const BitVolume* known)
      : triangles_(triangles_vx),
        surface_(surface),
        box_(box),
        inside_(solid || known != nullptr ? box.count() : 0) {
    Bytes skin(box.count());
    for (std::size_t axis = 0; axis < kAxes.size(); ++axis) {
      const Lines lines(kAxes[axis], box_);
      lines.forEachCrossed(triangles_, [&](std::uint32_t line, std::span<const Crossing> crossings) {
        if (solid) vote(box_, lines, line, crossings, inside_);
        markSkin(box_, lines, static_cast<int>(axis), line, crossings, skin);
      });
    }
    skin_ = std::move(skin);
    if (solid) settle();
    if (known != nullptr) copy(*known);
  }

  /// Writes the rows y_first .. y_last.
  void write(int y_first, int y_last, Filled& filled) const {
    const auto rows = static_cast<std::size_t>(y_last - y_first + 1);
    std::vector<Filled> counts(rows);
    parallelForEach(rows, [&](std::size_t row) {
      const int y = y_first + static_cast<int>(row);
      for (int z = box_.first.z; z <= box_.last.z; ++z) {
        for (int x = box_.first.x; x <= box_.last.x; ++x) {
          const Voxel v(x, y, z);
          if (x + 8 <= box_.last.x && nothingInEight(v)) {
            x += 7;
            continue;
          }
          if (takesLight(v)) filled.opaque.set(v);
          if (inside_.empty() || surface_.at(v)) continue;
          const std::uint8_t state = inside_[box_.index(v)];
          if ((state & kInside) != 0) filled.inside.set(v);
          if ((state & kDoubtful) != 0) ++counts[row].doubtful;
          if ((state & (kDoubtful | kInside)) == kDoubtful) ++counts[row].outvoted;
          if ((state & kUndecided) != 0) ++counts[row].undecided;
        }
      }
    });
    for (const Filled& count : counts) {
      filled.doubtful += count.doubtful;
      filled.outvoted += count.outvoted;
      filled.undecided += count.undecided;
    }
  }

 private:
  static constexpr std::uint8_t kInside = 1, kDoubtful = 2, kUndecided = 4;

  void copy(const BitVolume& inside) {
    parallelForEach(static_cast<std::size_t>(box_.size().y), [&](std::size_t row) {
      const int y = box_.first.y + static_cast<int>(row);
      for (int z = box_.first.z; z <= box_.last.z; ++z) {
        for (int w = 0; w < inside.rowWords() - 1; ++w) {
          for (std::uint64_t word = inside.row(y, z)[w]; word != 0; word &= word - 1) {
            const Voxel v(w * BitVolume::kWordBits + std::countr_zero(word), y, z);
            if (box_.has(v)) inside_[box_.index(v)] = kInside;
          }
        }
      }
    });
  }

  /// Turns votes into kInside, kDoubtful and kUndecided.
  void settle() {
    constexpr int kAll = 2 * static_cast<int>(kAxes.size());
    const auto doubtful = [](std::uint8_t votes) { return votes > 1 && votes < kAll; };
    if (std::none_of(inside_.begin(), inside_.end(), doubtful)) {
      for (std::uint8_t& v : inside_) v = v == kAll ? kInside : 0;
      return;
    }
    Bytes votes = inside_;
    for (const LineDirection& d : kDiagonals) {
      const Lines lines(d, box_);
      lines.forEachCrossed(triangles_, [&](std::uint32_t line, std::span<const Crossing> crossings) {
        vote(box_, lines, line, crossings, votes);
      });
    }
    constexpr int kHalf = static_cast<int>(kAxes.size() + kDiagonals.size());
    for (std::size_t i = 0; i < inside_.size(); ++i) {
      std::uint8_t& v = inside_[i];
      if (doubtful(v)) {
        const int ends = votes[i];
        const bool close = 3 * std::max(ends, 2 * kHalf - ends) < 4 * kHalf;
        v = static_cast<std::uint8_t>(kDoubtful | (ends > kHalf ? kInside : 0) | (close ? kUndecided : 0));
      } else {
        v = v == kAll ? kInside : 0;
      }
    }
  }

  /// Most of a box is air.
  bool nothingInEight(Voxel first) const {
    const std::size_t at = box_.index(first);
    std::uint64_t skin = 0, inside = 0;
    std::memcpy(&skin, skin_.data() + at, 8);
    if (!inside_.empty()) std::memcpy(&inside, inside_.data() + at, 8);
    return (skin | inside) == 0;
  }

  bool isInside(Voxel v) const {
    return !inside_.empty() && box_.has(v) && (inside_[box_.index(v)] & kInside) != 0;
  }
  bool takesLight(Voxel v) const {
    if (isInside(v)) return true;
    const unsigned marks = skin_[box_.index(v)];
    for (int axis = 0; marks >> (2 * axis) != 0; ++axis) {
      Voxel step(0);
      step[axis] = 1;
      if ((marks >> (2 * axis) & 1u) != 0 && !isInside(v - step)) return true;
      if ((marks >> (2 * axis) & 2u) != 0 && !isInside(v + step)) return true;
    }
    return false;
  }

  const Triangles& triangles_;
  const BitVolume& surface_;
  VoxelBox box_;
  Bytes inside_, skin_;
};

/// Wires and points, whose triangles have no area, take the light of every voxel that they touch.
void addWires(const Triangles& triangles_vx, BitVolume& opaque) {
  std::vector<Voxel> voxels;
  for (const auto& t : triangles_vx) {
    const Fixed a = fixedFromVoxel(t[0]);
    const Fixed u = fixedFromVoxel(t[1]) - a, v = fixedFromVoxel(t[2]) - a;
    if (u.y * v.z != u.z * v.y || u.z * v.x != u.x * v.z || u.x * v.y != u.y * v.x) continue;
    tileTriangle(t, voxels);
  }
  for (const Voxel v : voxels) {
    if (contains(opaque.size(), v)) opaque.set(v);
  }
}

Filled fillBox(const Triangles& triangles_vx, const BitVolume& surface, bool solid, const BitVolume* known) {
  Filled filled{solid || known != nullptr ? BitVolume(surface.size()) : BitVolume(),
                BitVolume(surface.size()), 0};
  const VoxelBox box = boxOf(triangles_vx, surface.size());
  if (box.empty()) return filled;
  forEachSlab(box, [&](int first, int last) {
    VoxelBox slab = box;
    slab.first.y = std::max(box.first.y, first - 1);
    slab.last.y = std::min(box.last.y, last + 1);
    Slab(triangles_vx, surface, slab, solid, known).write(first, last, filled);
  });
  addWires(triangles_vx, filled.opaque);
  return filled;
}

}  // namespace

VoxelBox boxOf(const Triangles& triangles_vx, Voxel size) {
  VoxelBox box{size, Voxel(-1)};
  for (const auto& t : triangles_vx) {
    for (const Vec3& p : t) {
      box.first = glm::min(box.first, tilePoint(p));
      box.last = glm::max(box.last, tilePoint(p));
    }
  }
  return {glm::max(box.first - 1, Voxel(0)), glm::min(box.last + 1, size - 1)};
}

void forEachSlab(const VoxelBox& box, const std::function<void(int, int)>& work) {
  constexpr std::size_t kMostBytes = std::size_t{1} << 28;
  const std::size_t slice = box.count() / static_cast<std::size_t>(box.size().y);
  const int rows = static_cast<int>(std::clamp<std::size_t>(kMostBytes / slice, 1, 1 << 14));
  for (int y = box.first.y; y <= box.last.y; y += rows) work(y, std::min(y + rows - 1, box.last.y));
}

Filled fillMesh(const Triangles& triangles_vx, const BitVolume& surface, bool solid) {
  return fillBox(triangles_vx, surface, solid, nullptr);
}

Filled fillMesh(const Triangles& triangles_vx, const BitVolume& surface, const BitVolume& inside) {
  return fillBox(triangles_vx, surface, false, &inside);
}

}  // namespace espalier::sim
