#pragma once
// Internal to the room: lines of voxel centres and where they cross a mesh's triangles, found exactly in
// whole numbers. A line that meets an edge or a corner, and a centre that lies on a triangle, are settled by
// moving all centres by (e, e^2, e^3) (Edelsbrunner and Muecke 1990): triangles which share an edge are
// crossed once together, and lines of all directions agree on a centre, as they all go through the moved one.
#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "sim/base/vec.h"

namespace espalier::sim {

using Triangles = std::vector<std::array<Vec3, 3>>;

/// Lattice direction with 1 along `axis` and a, b along the two axes after it. The shear (u, v, w) =
/// (p0, p1 - a p0, p2 - b p0) turns it into the direction u, and the lattice into itself.
struct LineDirection {
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

/// A box of voxels, both corners included.
struct VoxelBox {
  Voxel first, last;

  Voxel size() const { return last - first + 1; }
  bool empty() const { return size().x < 1 || size().y < 1 || size().z < 1; }
  bool has(Voxel v) const {
    return v.x >= first.x && v.y >= first.y && v.z >= first.z && v.x <= last.x && v.y <= last.y &&
           v.z <= last.z;
  }
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

struct Crossing {
  std::uint32_t line;
  std::int32_t at;    ///< along the line in 1/4096 voxel, rounded up
  std::int32_t turn;  ///< +1 or -1: which side of the triangle the line comes from

  /// The first voxel centre at or after it.
  int before() const { return (at + 4095) >> 12; }
};

/// The lines of one direction that meet a box.
class Lines {
 public:
  Lines(LineDirection direction, const VoxelBox& box);

  std::size_t count() const;
  /// First and last voxel of all lines, along them.
  int first() const { return first_.x; }
  int last() const { return last_.x; }
  Voxel voxel(std::uint32_t line, int u) const {
    const auto width = static_cast<std::uint32_t>(last_.z - first_.z + 1);
    return direction_.voxel(u, static_cast<int>(line / width) + first_.y,
                            static_cast<int>(line % width) + first_.z);
  }

  /// Appends a triangle's crossings. Those beyond the ends of the lines are moved to just outside of them.
  void cross(const std::array<Vec3, 3>& triangle_vx, std::vector<Crossing>& crossings) const;

  /// Calls work(line, its crossings in order) for each line that has any, in parallel. Lines of one direction
  /// share no voxels.
  void forEachCrossed(const Triangles& triangles_vx,
                      const std::function<void(std::uint32_t, std::span<const Crossing>)>& work) const;

 private:
  std::uint32_t line(int v, int w) const {
    return static_cast<std::uint32_t>(v - first_.y) * static_cast<std::uint32_t>(last_.z - first_.z + 1) +
           static_cast<std::uint32_t>(w - first_.z);
  }

  LineDirection direction_;
  Voxel first_, last_;  ///< in sheared coordinates
};

}  // namespace espalier::sim
