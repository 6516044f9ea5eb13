#include "sim/tile/closed.h"

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <span>

#include "sim/base/parallel.h"
#include "sim/tile/bodies.h"
#include "sim/tile/fill.h"

namespace espalier::sim {
namespace {

constexpr std::array<LineDirection, 3> kWays{{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}}};
constexpr int kEnds = 5;          // of lines through a centre, without the one that leads down
constexpr int kLikelyEnds = 3;    // of these agree where it may be inside
constexpr double kMostOf = 0.75;  // of a body's centres that may be inside are enclosed

/// What the ends found of a voxel: how many of them the winding number that the first did (low four bits),
/// and that number plus 8 (high four); 0: nothing yet.
void find(std::uint8_t& found, int winding) {
  const int number = std::clamp(winding, -7, 7) + 8;
  if (found == 0) {
    found = static_cast<std::uint8_t>(number << 4 | 1);
  } else if (found >> 4 == number) {
    ++found;
  }
}

int agreeing(std::uint8_t found) {
  return found & 15;
}

void judge(const VoxelBox& box, const Lines& lines, bool upright, std::uint32_t line,
           std::span<const Crossing> crossings, std::vector<std::uint8_t>& found) {
  int after = 0;  // turns
  for (const Crossing& c : crossings) after += c.turn;
  int before = 0, from = lines.first();
  for (std::size_t i = 0; i <= crossings.size(); ++i) {
    const int to = i < crossings.size() ? crossings[i].before() : lines.last() + 1;
    const int low_end = upright ? 0 : before;  // an upright line's leads down
    for (int u = from; (low_end != 0 || after != 0) && u < to; ++u) {
      const Voxel v = lines.voxel(line, u);
      if (!box.has(v)) continue;
      std::uint8_t& of_it = found[box.index(v)];
      if (low_end != 0) find(of_it, low_end);
      if (after != 0) find(of_it, -after);
    }
    if (i == crossings.size()) break;
    before += crossings[i].turn;
    after -= crossings[i].turn;
    from = to;
  }
}

/// The centres that are enclosed, and those that may be inside, all of them included.
struct Judged {
  BitVolume enclosed, likely;
};

void judgeSlab(const Triangles& triangles, const VoxelBox& slab, Judged& judged) {
  std::vector<std::uint8_t> found(slab.count());
  for (const LineDirection& way : kWays) {
    const Lines lines(way, slab);
    lines.forEachCrossed(triangles, [&](std::uint32_t line, std::span<const Crossing> crossings) {
      judge(slab, lines, way.axis == 1, line, crossings, found);
    });
  }
  parallelForEach(static_cast<std::size_t>(slab.size().y), [&](std::size_t row) {
    const int y = slab.first.y + static_cast<int>(row);
    for (int z = slab.first.z; z <= slab.last.z; ++z) {
      for (int x = slab.first.x; x <= slab.last.x; ++x) {
        const Voxel v(x, y, z);
        std::uint64_t eight = 1;
        if (x + 8 <= slab.last.x) std::memcpy(&eight, found.data() + slab.index(v), 8);
        if (eight == 0) {  // most of a box is air
          x += 7;
          continue;
        }
        const int ends = agreeing(found[slab.index(v)]);
        if (ends >= kLikelyEnds) judged.likely.set(v);
        if (ends == kEnds) judged.enclosed.set(v);
      }
    }
  });
}

/// Adds bodies most of which the mesh winds around.
void addWound(const Judged& judged, const BitVolume& surface, BitVolume& inside) {
  Bodies bodies(judged.likely, surface);
  struct Counted {
    std::size_t voxels = 0, enclosed = 0;
  };
  std::vector<Counted> counted(bodies.runs().size());
  for (std::size_t i = 0; i < counted.size(); ++i) {
    Counted& body = counted[bodies.bodyOf(i)];
    body.voxels += bodies.runs()[i].voxels();
    body.enclosed += countIn(judged.enclosed, bodies.runs()[i]);
  }
  for (std::size_t i = 0; i < counted.size(); ++i) {
    const Counted& body = counted[bodies.bodyOf(i)];
    if (static_cast<double>(body.enclosed) >= kMostOf * static_cast<double>(body.voxels))
      setRun(inside, bodies.runs()[i]);
  }
}

bool anyAt(const BitVolume& voxels, int y) {
  const std::uint64_t* const first = voxels.row(y, 0);
  const std::size_t words =
      static_cast<std::size_t>(voxels.rowWords()) * static_cast<std::size_t>(voxels.size().z);
  return std::any_of(first, first + words, [](std::uint64_t word) { return word != 0; });
}

/// Adds what no way leads to that does not cross the surface's voxels or come from below its foot.
void addCavities(const BitVolume& surface, const VoxelBox& box, BitVolume& inside) {
  BitVolume air(surface.size());
  int foot = box.first.y;
  while (foot < box.last.y && !anyAt(surface, foot)) ++foot;
  for (int y = foot; y <= box.last.y; ++y) {
    for (int z = box.first.z; z <= box.last.z; ++z) setRun(air, {y, z, box.first.x, box.last.x});
  }
  Bodies bodies(air, surface, foot);
  std::vector<bool> open(bodies.runs().size());
  for (std::size_t i = 0; i < open.size(); ++i) {
    const Run& run = bodies.runs()[i];
    const bool at_the_rim = run.first == box.first.x || run.last == box.last.x || run.z == box.first.z ||
                            run.z == box.last.z || run.y == box.last.y;
    if (at_the_rim) open[bodies.bodyOf(i)] = true;
  }
  for (std::size_t i = 0; i < open.size(); ++i) {
    if (!open[bodies.bodyOf(i)]) setRun(inside, bodies.runs()[i]);
  }
}

/// Adds the surface's voxels whose centres may be inside, where what they are a surface of is. Of what may be
/// inside only they are left: a world has many voxels, and no other volume is needed.
void addSkins(Judged& judged, const BitVolume& surface, BitVolume& inside) {
  const Voxel size = surface.size();
  parallelForEach(static_cast<std::size_t>(size.y), [&](std::size_t slice) {
    const int y = static_cast<int>(slice);
    for (int z = 0; z < size.z; ++z) {
      const std::uint64_t* const row = inside.row(y, z);
      for (int w = 0; w < surface.rowWords() - 1; ++w) {
        std::uint64_t beside = row[w] << 1 | row[w - 1] >> 63 | row[w] >> 1 | row[w + 1] << 63;
        if (y > 0) beside |= inside.row(y - 1, z)[w];
        if (y + 1 < size.y) beside |= inside.row(y + 1, z)[w];
        if (z > 0) beside |= inside.row(y, z - 1)[w];
        if (z + 1 < size.z) beside |= inside.row(y, z + 1)[w];
        std::uint64_t& skin = judged.likely.row(y, z)[w];
        skin = surface.row(y, z)[w] & (judged.enclosed.row(y, z)[w] | (skin & beside));
      }
    }
  });
  inside.add(judged.likely);
}

}  // namespace

BitVolume enclosedBy(const Triangles& triangles_vx, const BitVolume& surface) {
  const Voxel size = surface.size();
  BitVolume inside(size);
  const VoxelBox box = boxOf(triangles_vx, size);
  if (box.empty()) return inside;
  addCavities(surface, box, inside);
  Judged judged{BitVolume(size), BitVolume(size)};
  forEachSlab(box, [&](int first, int last) {
    VoxelBox slab = box;
    slab.first.y = first;
    slab.last.y = last;
    judgeSlab(triangles_vx, slab, judged);
  });
  addWound(judged, surface, inside);
  addSkins(judged, surface, inside);
  return inside;
}

}  // namespace espalier::sim
