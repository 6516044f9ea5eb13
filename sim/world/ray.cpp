#include "sim/world/ray.h"

#include <algorithm>
#include <cmath>
#include <limits>

// John Amanatides and Andrew Woo, "A Fast Voxel Traversal Algorithm for Ray Tracing", Eurographics 1987.
//
// A ray crosses the planes between voxels in an order that is fixed by (t, axis), where t of plane k is
// always (k - origin) / direction, computed afresh and never accumulated. Planes between bricks are planes
// between voxels and have the same t, so walking bricks first visits exactly the voxels that walking voxels
// alone would visit: where a walk resumes after a jump, planeCrossed() tells for each axis which planes come
// before the crossing that was just made.
namespace espalier::sim {
namespace {

constexpr int kBrick = 8;
constexpr double kNever = std::numeric_limits<double>::infinity();

/// The ray with cubes at [v, v + 1), so that planes are whole numbers.
struct Ray {
  Vec3 origin, direction, inverse;
  Voxel step;   ///< -1, 0 or 1
  Voxel ahead;  ///< 1 where the next plane lies above the cube's own index, else 0

  double t(int axis, int plane) const { return (plane - origin[axis]) * inverse[axis]; }
  double tNext(int axis, int index) const { return step[axis] == 0 ? kNever : t(axis, index + ahead[axis]); }
};

Ray makeRay(Vec3 origin_vx, Vec3 direction) {
  Ray ray{origin_vx + 0.5, direction, Vec3(0.0), Voxel(0), Voxel(0)};
  for (int axis = 0; axis < 3; ++axis) {
    const double d = direction[axis];
    ray.step[axis] = d > 0.0 ? 1 : d < 0.0 ? -1 : 0;
    ray.ahead[axis] = d > 0.0 ? 1 : 0;
    if (d != 0.0) ray.inverse[axis] = 1.0 / d;
  }
  return ray;
}

/// The crossing of a plane; axis -1 is the ray's own beginning.
struct Crossing {
  double t = 0.0;
  int axis = -1;
  bool before(double other_t, int other_axis) const {
    return t < other_t || (t == other_t && axis < other_axis);
  }
};

/// The axis whose plane is crossed next: x before y before z where they are crossed at once.
int nextAxis(const Vec3& t) {
  return t.x <= t.y ? (t.x <= t.z ? 0 : 2) : (t.y <= t.z ? 1 : 2);
}

/// The ray's cube along one axis right after a crossing of another axis; -1 and size stand for all that is
/// outside.
int indexAfter(const Ray& ray, const Crossing& now, int axis, int size) {
  const auto clamped = [size](double v) {
    return static_cast<int>(std::clamp(std::floor(v), -1.0, double(size)));
  };
  const int first = clamped(ray.origin[axis]);
  const int step = ray.step[axis];
  if (step == 0 || now.axis < 0) return first;
  const auto crossed = [&](int plane) { return !now.before(ray.t(axis, plane), axis); };
  int index = clamped(ray.origin[axis] + now.t * ray.direction[axis]);
  if (step > 0) {
    while (index < size && crossed(index + 1)) ++index;
    while (index > first && !crossed(index)) --index;
  } else {
    while (index >= 0 && crossed(index)) --index;
    while (index < first && !crossed(index + 1)) ++index;
  }
  return index;
}

/// The crossing by which the ray comes into the box; false if it cannot.
bool enterBox(const Ray& ray, Voxel size, Crossing& entry) {
  for (int axis = 0; axis < 3; ++axis) {
    const double o = ray.origin[axis];
    if (o >= 0.0 && o < size[axis]) continue;
    const bool below = o < 0.0;
    if (ray.step[axis] != (below ? 1 : -1)) return false;
    const double t = ray.t(axis, below ? 0 : size[axis]);
    if (!std::isfinite(t)) return false;
    if (entry.before(t, axis)) entry = {t, axis};
  }
  return true;
}

RayHit hitAt(const Ray& ray, Voxel voxel, const Crossing& crossing) {
  RayHit hit{voxel, Voxel(0), crossing.t};
  if (crossing.axis >= 0) hit.face[crossing.axis] = -ray.step[crossing.axis];
  return hit;
}

}  // namespace

Bricks::Bricks(const BitVolume& occupied) : bits_((occupied.size() + (kBrick - 1)) / kBrick) {
  const Voxel size = occupied.size();
  for (int y = 0; y < size.y; ++y) {
    for (int z = 0; z < size.z; ++z) {
      const std::uint64_t* row = occupied.row(y, z);
      for (int bx = 0; bx < bits_.size().x; ++bx) {
        const int x = bx * kBrick;
        if (((row[x >> 6] >> (x & 63)) & 0xffu) != 0) bits_.set({bx, y / kBrick, z / kBrick});
      }
    }
  }
}

std::optional<RayHit> firstHit(const BitVolume& occupied, const Bricks& bricks, Vec3 origin_vx,
                               Vec3 direction) {
  const Voxel size = occupied.size();
  const Ray ray = makeRay(origin_vx, direction);
  Crossing now;
  if (!enterBox(ray, size, now)) return std::nullopt;

  Voxel voxel;
  for (int axis = 0; axis < 3; ++axis) {
    voxel[axis] =
        axis == now.axis ? (ray.step[axis] > 0 ? 0 : size[axis] - 1) : indexAfter(ray, now, axis, size[axis]);
  }
  if (!contains(size, voxel)) return std::nullopt;

  const Voxel brick_count = (size + (kBrick - 1)) / kBrick;
  Voxel brick = voxel / kBrick;
  Vec3 brick_t;
  for (int axis = 0; axis < 3; ++axis)
    brick_t[axis] = ray.step[axis] == 0 ? kNever : ray.t(axis, (brick[axis] + ray.ahead[axis]) * kBrick);

  while (true) {
    if (bricks.any(brick)) {
      const Voxel low = brick * kBrick;
      const Voxel high = glm::min(low + kBrick, size);
      for (int axis = 0; axis < 3; ++axis) {
        if (axis == now.axis || now.axis < 0) continue;
        voxel[axis] = indexAfter(ray, now, axis, size[axis]);
      }
      if (!contains(size, voxel)) return std::nullopt;  // the world may end within a brick
      Vec3 t{ray.tNext(0, voxel.x), ray.tNext(1, voxel.y), ray.tNext(2, voxel.z)};
      Crossing here = now;
      while (true) {
        if ((occupied.row(voxel.y, voxel.z)[voxel.x >> 6] >> (voxel.x & 63)) & 1u)
          return hitAt(ray, voxel, here);
        const int axis = nextAxis(t);
        here = {t[axis], axis};
        voxel[axis] += ray.step[axis];
        if (voxel[axis] < low[axis] || voxel[axis] >= high[axis]) break;
        t[axis] = ray.tNext(axis, voxel[axis]);
      }
    }
    const int axis = nextAxis(brick_t);
    now = {brick_t[axis], axis};
    brick[axis] += ray.step[axis];
    if (brick[axis] < 0 || brick[axis] >= brick_count[axis]) return std::nullopt;
    voxel[axis] = ray.step[axis] > 0 ? brick[axis] * kBrick : brick[axis] * kBrick + kBrick - 1;
    brick_t[axis] = ray.t(axis, (brick[axis] + ray.ahead[axis]) * kBrick);
  }
}

}  // namespace espalier::sim
