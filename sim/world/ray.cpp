#include "sim/world/ray.h"

#include <algorithm>
#include <array>
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

constexpr int kBrick = Bricks::kSide;
constexpr double kNever = std::numeric_limits<double>::infinity();

/// The ray with cubes at [v, v + 1), so that planes are whole numbers.
/// Arrays, as a walk asks for axes by their number.
struct Ray {
  std::array<double, 3> origin, direction, inverse{};
  std::array<int, 3> step{};   ///< -1, 0 or 1
  std::array<int, 3> ahead{};  ///< 1 where the next plane lies above the cube's own index, else 0

  double t(std::size_t axis, double plane) const { return (plane - origin[axis]) * inverse[axis]; }
};

Ray makeRay(Vec3 origin_vx, Vec3 direction) {
  Ray ray{{origin_vx.x + 0.5, origin_vx.y + 0.5, origin_vx.z + 0.5}, {direction.x, direction.y, direction.z}};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double d = ray.direction[axis];
    ray.step[axis] = d > 0.0 ? 1 : d < 0.0 ? -1 : 0;
    ray.ahead[axis] = d > 0.0 ? 1 : 0;
    if (d != 0.0) ray.inverse[axis] = 1.0 / d;
  }
  return ray;
}

/// The crossing of a plane, or what stands for one: where the ray begins (kBegin, before all axes), and a
/// place past every plane of the same t (kPast).
struct Crossing {
  static constexpr int kBegin = -1, kPast = 3;

  double t = 0.0;
  int axis = kBegin;
  bool before(double other_t, int other_axis) const {
    return t < other_t || (t == other_t && axis < other_axis);
  }
};

/// The whole number below, of what lies within -1..size.
int clampedFloor(double v, int size) {
  const double within = std::clamp(v, -1.0, static_cast<double>(size));
  const int whole = static_cast<int>(within);
  return whole - (within < whole ? 1 : 0);
}

/// The ray's cube along one axis right after a crossing of another axis; -1 and size stand for all that is
/// outside.
int indexAfter(const Ray& ray, const Crossing& now, std::size_t axis, int size) {
  const int first = clampedFloor(ray.origin[axis], size);
  const int step = ray.step[axis];
  if (step == 0 || now.axis == Crossing::kBegin) return first;
  const auto crossed = [&](int plane) { return !now.before(ray.t(axis, plane), static_cast<int>(axis)); };
  int index = clampedFloor(ray.origin[axis] + now.t * ray.direction[axis], size);
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
bool enterBox(const Ray& ray, const std::array<int, 3>& size, Crossing& entry) {
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double o = ray.origin[axis];
    if (o >= 0.0 && o < size[axis]) continue;
    const bool below = o < 0.0;
    if (ray.step[axis] != (below ? 1 : -1)) return false;
    const double t = ray.t(axis, below ? 0 : size[axis]);
    if (!std::isfinite(t)) return false;
    if (entry.before(t, static_cast<int>(axis))) entry = {t, static_cast<int>(axis)};
  }
  return true;
}

using Cube = std::array<int, 3>;  ///< a voxel or a brick, by axes

Cube cubeOf(Voxel v) {
  return {v.x, v.y, v.z};
}

bool within(const Cube& size, const Cube& cube) {
  return cube[0] >= 0 && cube[1] >= 0 && cube[2] >= 0 && cube[0] < size[0] && cube[1] < size[1] &&
         cube[2] < size[2];
}

/// A walk along a ray from cube to cube, each a bit of a volume and `side` voxels wide. Borrows both.
class Walk {
 public:
  Walk(const Ray& ray, const BitVolume& volume, int side)
      : ray_(ray), words_(volume.words().data()), side_(side) {
    const std::int64_t row = std::int64_t{BitVolume::kWordBits} * volume.rowWords();
    apart_ = {1, row * volume.size().z, row};
    begin_ = (volume.row(0, 0) - words_) * BitVolume::kWordBits;
  }

  /// Goes to a cube, and is not to leave those from `low` to below `high`.
  void start(const Cube& cube, const Cube& low, const Cube& high) {
    bit_ = begin_;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      bit_ += cube[axis] * apart_[axis];
      left_[axis] = ray_.step[axis] > 0 ? high[axis] - 1 - cube[axis] : cube[axis] - low[axis];
      plane_[axis] = (cube[axis] + ray_.ahead[axis]) * side_;
      t_[axis] = ray_.step[axis] == 0 ? kNever : ray_.t(axis, plane_[axis]);
    }
  }
  bool occupied() const {
    const auto bit = static_cast<std::uint64_t>(bit_);
    return ((words_[bit / BitVolume::kWordBits] >> (bit % BitVolume::kWordBits)) & 1u) != 0;
  }
  /// Crosses the next plane, of x before y before z where they are met at once; false where it leads out.
  bool next(Crossing& crossing) {
    // note: branches beat an axis that is picked without any, as most rays cross planes in a rhythm.
    if (t_[0] <= t_[1]) return t_[0] <= t_[2] ? cross<0>(crossing) : cross<2>(crossing);
    return t_[1] <= t_[2] ? cross<1>(crossing) : cross<2>(crossing);
  }
  Cube cube() const {
    Cube here;
    for (std::size_t axis = 0; axis < 3; ++axis) here[axis] = plane_[axis] / side_ - ray_.ahead[axis];
    return here;
  }

 private:
  template <std::size_t kAxis>
  bool cross(Crossing& crossing) {
    crossing = {t_[kAxis], static_cast<int>(kAxis)};
    if (left_[kAxis]-- == 0) return false;
    bit_ += ray_.step[kAxis] * apart_[kAxis];
    plane_[kAxis] += ray_.step[kAxis] * side_;
    t_[kAxis] = ray_.t(kAxis, plane_[kAxis]);
    return true;
  }

  const Ray& ray_;
  const std::uint64_t* words_;
  int side_;
  std::int64_t begin_, bit_ = 0;  // in the volume's words
  std::array<std::int64_t, 3> apart_;
  std::array<double, 3> t_{};  // of the planes ahead
  std::array<int, 3> plane_{};
  std::array<int, 3> left_{};  // cubes ahead
};

RayHit hitAt(const Ray& ray, const Cube& cube, const Crossing& crossing) {
  RayHit hit{{cube[0], cube[1], cube[2]}, Voxel(0), crossing.t};
  if (crossing.axis != Crossing::kBegin && crossing.axis != Crossing::kPast)
    hit.face[crossing.axis] = -ray.step[static_cast<std::size_t>(crossing.axis)];
  return hit;
}

}  // namespace

std::optional<RayHit> firstHit(const BitVolume& occupied, const Bricks& bricks, Vec3 origin_vx,
                               Vec3 direction, double free_vx) {
  const Cube size = cubeOf(occupied.size());
  const Ray ray = makeRay(origin_vx, direction);
  Crossing now;
  if (!enterBox(ray, size, now)) return std::nullopt;
  if (free_vx > now.t) now = {free_vx, Crossing::kPast};

  Walk by_voxels(ray, occupied, 1);
  /// Within a brick, from the last crossing on.
  const auto throughBrick = [&](const Cube& voxel, const Cube& brick) -> std::optional<RayHit> {
    Cube low, high;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      low[axis] = brick[axis] * kBrick;
      high[axis] = std::min(low[axis] + kBrick, size[axis]);
    }
    by_voxels.start(voxel, low, high);
    Crossing crossing = now;
    do {
      if (by_voxels.occupied()) return hitAt(ray, by_voxels.cube(), crossing);
    } while (by_voxels.next(crossing));
    return std::nullopt;
  };

  Cube voxel;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    voxel[axis] = static_cast<int>(axis) == now.axis ? (ray.step[axis] > 0 ? 0 : size[axis] - 1)
                                                     : indexAfter(ray, now, axis, size[axis]);
  }
  if (!within(size, voxel)) return std::nullopt;
  const Cube first{voxel[0] / kBrick, voxel[1] / kBrick, voxel[2] / kBrick};
  if (bricks.bits().at({first[0], first[1], first[2]})) {
    if (const auto hit = throughBrick(voxel, first)) return hit;
  }

  Walk by_bricks(ray, bricks.bits(), kBrick);
  by_bricks.start(first, {0, 0, 0}, cubeOf(bricks.bits().size()));
  while (by_bricks.next(now)) {
    if (!by_bricks.occupied()) continue;
    const Cube brick = by_bricks.cube();
    for (std::size_t axis = 0; axis < 3; ++axis) {
      voxel[axis] = static_cast<int>(axis) == now.axis
                        ? brick[axis] * kBrick + (ray.step[axis] > 0 ? 0 : kBrick - 1)
                        : indexAfter(ray, now, axis, size[axis]);
    }
    if (!within(size, voxel)) return std::nullopt;  // the world may end within a brick
    if (const auto hit = throughBrick(voxel, brick)) return hit;
  }
  return std::nullopt;
}

}  // namespace espalier::sim
