#include "render/voxels/cube_drawing.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <optional>
#include <span>

#include "render/image/drawing.h"
#include "render/image/tone.h"
#include "render/voxels/pale_scene.h"
#include "sim/base/bits.h"
#include "sim/base/faces.h"
#include "sim/tile/clip.h"

namespace espalier::render {
namespace {

using sim::Vec3;

constexpr sim::Colour kWall[3] = {
    {0.950f, 0.947f, 0.938f}, {0.925f, 0.924f, 0.918f}, {0.968f, 0.965f, 0.956f}};
constexpr Ink kLattice{sim::Colour(0.32f, 0.36f, 0.42f), 0.30f};
constexpr Ink kRimOfWorld{sim::Colour(0.20f, 0.23f, 0.28f), 0.75f};
constexpr Ink kWallShade{sim::Colour(0.25f, 0.28f, 0.33f), 0.11f};
constexpr sim::Colour kPen(0.12f, 0.13f, 0.16f);

/// How much of the light cubes keep by the axis that a face looks along; what looks down keeps the least.
constexpr float kLightOnAxis[3] = {0.80f, 1.0f, 0.90f};
constexpr float kLightBelow = 0.68f;
/// Cubes are paler than what is in them, which is seen through their faces.
constexpr float kPaler = 0.45f;
constexpr float kFrontOpacity = 0.36f, kBackOpacity = 0.36f;
constexpr float kHiddenEdge = 0.28f;
/// Parts of a primitive in neighbouring voxels run into each other by so many voxel widths, as its fill would
/// have seams.
constexpr double kOverlap_vx = 0.01;

/// The four corners of a face of the box between two corners, in order around it.
std::array<Vec3, 4> faceCorners(Vec3 low, Vec3 high, std::uint8_t face) {
  const Vec3 normal(sim::kFaceNormals[face]);
  const int axis = sim::faceAxis(face);
  const int across = (axis + 1) % 3, up = (axis + 2) % 3;
  std::array<Vec3, 4> corners;
  for (std::size_t i = 0; i < 4; ++i) {
    corners[i][axis] = normal[axis] > 0.0 ? high[axis] : low[axis];
    corners[i][across] = i == 1 || i == 2 ? high[across] : low[across];
    corners[i][up] = i >= 2 ? high[up] : low[up];
  }
  return corners;
}

/// Numbers of voxels along an axis, from the farthest from the eye to the nearest.
std::vector<int> farToNear(int count, double eye_vx) {
  std::vector<int> order(static_cast<std::size_t>(count));
  for (int i = 0; i < count; ++i) order[static_cast<std::size_t>(i)] = i;
  std::stable_sort(order.begin(), order.end(),
                   [&](int a, int b) { return std::abs(a - eye_vx) > std::abs(b - eye_vx); });
  return order;
}

class CubePainter {
 public:
  CubePainter(const CubeWorld& world, const Camera& camera, int width_px, int height_px)
      : world_(world),
        projection_(camera, width_px, height_px),
        near_m_(1e-3 * glm::length(camera.target_m - camera.eye_m)),
        eye_vx_(sim::voxelFromWorld(world.frame, camera.eye_m)),
        pen_(penOf(world.frame, height_px)),
        picture_(paper(width_px, height_px)),
        taken_(world.frame.size) {
    for (const Cube& cube : world.cubes) taken_.set(cube.voxel);
  }

  Image draw() && {
    walls();
    sortPrimitives();
    const sim::Voxel size = world_.frame.size;
    const auto xs = farToNear(size.x, eye_vx_.x), ys = farToNear(size.y, eye_vx_.y),
               zs = farToNear(size.z, eye_vx_.z);
    // What hides another voxel is nearer along each axis, or as near: any nesting of the three will do.
    for (const int y : ys)
      for (const int x : xs)
        for (const int z : zs)
          if (const Cube* cube = cubes_[number({x, y, z})]) this->cube(*cube);
    rims();
    return std::move(picture_);
  }

 private:
  /// As suits the picture, but no thicker than small voxels allow.
  float penOf(const sim::Frame& frame, int height_px) const {
    const Vec3 middle_m = sim::worldFromVoxel(frame, 0.5 * Vec3(frame.size));
    const double depth = std::max(projection_.depth_m(middle_m), near_m_);
    const float voxel_px = static_cast<float>(frame.voxel_m * projection_.pixelsAt(depth));
    return std::clamp(0.033f * voxel_px, 0.4f, std::max(0.8f, static_cast<float>(height_px) / 560.0f));
  }

  std::size_t number(sim::Voxel v) const {
    const sim::Voxel size = world_.frame.size;
    return (static_cast<std::size_t>(v.y) * static_cast<std::size_t>(size.z) +
            static_cast<std::size_t>(v.z)) *
               static_cast<std::size_t>(size.x) +
           static_cast<std::size_t>(v.x);
  }

  /// Nothing where it lies behind the eye.
  std::optional<glm::vec2> pixel(Vec3 at_vx) const {
    const Vec3 at_m = sim::worldFromVoxel(world_.frame, at_vx);
    if (!(projection_.depth_m(at_m) > near_m_)) return std::nullopt;
    return projection_.pixel(at_m);
  }

  void fill(std::span<const Vec3> corners_vx, Ink ink) {
    std::vector<glm::vec2> corners;
    for (const Vec3 corner : corners_vx) {
      const auto at = pixel(corner);
      if (!at) return;
      corners.push_back(*at);
    }
    fillConvex(picture_, corners, ink);
  }

  void stroke(Vec3 a_vx, Vec3 b_vx, float width_px, Ink ink) {
    const auto a = pixel(a_vx), b = pixel(b_vx);
    if (a && b) drawSegment(picture_, *a, *b, width_px, ink);
  }

  void outline(std::span<const Vec3> corners_vx, float width_px, Ink ink) {
    for (std::size_t i = 0; i < corners_vx.size(); ++i)
      stroke(corners_vx[i], corners_vx[(i + 1) % corners_vx.size()], width_px, ink);
  }

  /// Whether the eye is on the side of a face of a box to which it looks.
  bool faces(Vec3 low, Vec3 high, std::uint8_t face) const {
    const Vec3 normal(sim::kFaceNormals[face]);
    const Vec3 on = faceCorners(low, high, face)[0];
    return glm::dot(eye_vx_ - on, normal) > 0.0;
  }

  Vec3 low() const { return Vec3(-0.5); }
  Vec3 high() const { return Vec3(world_.frame.size) - 0.5; }

  /// The world's walls with the lattice on them, and on each the shade of the cubes before it.
  void walls() {
    const Vec3 size(world_.frame.size);
    for (std::uint8_t face = 0; face < sim::kFaces; ++face) {
      if (faces(low(), high(), face)) continue;
      const int axis = sim::faceAxis(face);
      const auto corners = faceCorners(low(), high(), face);
      fill(corners, {kWall[axis], 1.0f});
      shades(axis, corners[0][axis]);
      for (const int along : {(axis + 1) % 3, (axis + 2) % 3}) {
        const int other = 3 - axis - along;
        for (int i = 1; i < world_.frame.size[along]; ++i) {
          Vec3 a = corners[0];
          a[along] = i - 0.5;
          a[other] = low()[other];
          Vec3 b = a;
          b[other] = high()[other];
          stroke(a, b, 0.8f * pen_, kLattice);
        }
      }
      outline(corners, 1.1f * pen_, kRimOfWorld);
    }
  }

  /// Squares of a wall at right angles to an axis before which there are cubes.
  void shades(int axis, double at) {
    const int across = (axis + 1) % 3, up = (axis + 2) % 3;
    const sim::Voxel size = world_.frame.size;
    std::vector<bool> before(static_cast<std::size_t>(size[across]) * static_cast<std::size_t>(size[up]));
    for (const Cube& cube : world_.cubes)
      before[static_cast<std::size_t>(cube.voxel[up]) * static_cast<std::size_t>(size[across]) +
             static_cast<std::size_t>(cube.voxel[across])] = true;
    for (int v = 0; v < size[up]; ++v) {
      for (int u = 0; u < size[across]; ++u) {
        if (!before[static_cast<std::size_t>(v) * static_cast<std::size_t>(size[across]) +
                    static_cast<std::size_t>(u)])
          continue;
        std::array<Vec3, 4> square;
        for (std::size_t i = 0; i < 4; ++i) {
          square[i][axis] = at;
          square[i][across] = u + (i == 1 || i == 2 ? 0.5 : -0.5);
          square[i][up] = v + (i >= 2 ? 0.5 : -0.5);
        }
        fill(square, kWallShade);
      }
    }
  }

  /// The world's edges that no wall has, which pass before everything.
  void rims() {
    for (std::uint8_t a = 0; a < sim::kFaces; ++a) {
      for (std::uint8_t b = 0; b < a; ++b) {
        const Vec3 n(sim::kFaceNormals[a]), m(sim::kFaceNormals[b]);
        if (glm::dot(n, m) != 0.0 || !faces(low(), high(), a) || !faces(low(), high(), b)) continue;
        const Vec3 side = glm::cross(n, m);
        Vec3 from = 0.5 * (low() + high()), to = from;
        for (int axis = 0; axis < 3; ++axis) {
          const double way = n[axis] + m[axis];
          if (way != 0.0) from[axis] = to[axis] = way > 0.0 ? high()[axis] : low()[axis];
          if (side[axis] != 0.0) from[axis] = low()[axis], to[axis] = high()[axis];
        }
        stroke(from, to, 1.1f * pen_, {kRimOfWorld.colour, 0.45f});
      }
    }
  }

  /// Finds which primitives pass through which cube.
  void sortPrimitives() {
    const sim::Voxel size = world_.frame.size;
    const std::size_t all = number({size.x - 1, size.y - 1, size.z - 1}) + 1;
    cubes_.assign(all, nullptr);
    for (const Cube& cube : world_.cubes) cubes_[number(cube.voxel)] = &cube;
    triangles_.resize(all);
    lines_.resize(all);
    const auto inEach = [&](Vec3 least, Vec3 most, auto&& put) {
      const sim::Voxel a = glm::max(sim::voxelAt(least) - 1, sim::Voxel(0));
      const sim::Voxel b = glm::min(sim::voxelAt(most) + 1, size - 1);
      for (int y = a.y; y <= b.y; ++y)
        for (int z = a.z; z <= b.z; ++z)
          for (int x = a.x; x <= b.x; ++x)
            if (taken_.at({x, y, z})) put(number({x, y, z}));
    };
    for (std::size_t i = 0; i < world_.triangles.size(); ++i) {
      std::array<Vec3, 3> at;
      for (std::size_t k = 0; k < 3; ++k)
        at[k] = sim::voxelFromWorld(world_.frame, world_.triangles[i].corners_m[k]);
      triangles_vx_.push_back(at);
      inEach(glm::min(glm::min(at[0], at[1]), at[2]), glm::max(glm::max(at[0], at[1]), at[2]),
             [&](std::size_t n) { triangles_[n].push_back(i); });
    }
    for (std::size_t i = 0; i < world_.lines.size(); ++i) {
      const Vec3 a = sim::voxelFromWorld(world_.frame, world_.lines[i].from_m),
                 b = sim::voxelFromWorld(world_.frame, world_.lines[i].to_m);
      lines_vx_.push_back({a, b});
      inEach(glm::min(a, b), glm::max(a, b), [&](std::size_t n) { lines_[n].push_back(i); });
    }
  }

  /// The part of a line in a box, or nothing.
  static std::optional<std::array<Vec3, 2>> partIn(Vec3 a, Vec3 b, Vec3 low, Vec3 high) {
    double from = 0.0, to = 1.0;
    for (int axis = 0; axis < 3; ++axis) {
      const double way = b[axis] - a[axis];
      if (way == 0.0) {
        if (a[axis] < low[axis] || a[axis] > high[axis]) return std::nullopt;
        continue;
      }
      const double one = (low[axis] - a[axis]) / way, other = (high[axis] - a[axis]) / way;
      from = std::max(from, std::min(one, other));
      to = std::min(to, std::max(one, other));
    }
    if (from > to) return std::nullopt;
    return std::array{glm::mix(a, b, from), glm::mix(a, b, to)};
  }

  void lineIn(Vec3 a, Vec3 b, Vec3 low, Vec3 high, float width_px, Ink ink) {
    if (const auto part = partIn(a, b, low, high)) stroke((*part)[0], (*part)[1], width_px, ink);
  }

  void primitivesIn(const Cube& cube) {
    const Vec3 middle(cube.voxel), low = middle - (0.5 + kOverlap_vx), high = middle + (0.5 + kOverlap_vx);
    const std::size_t n = number(cube.voxel);
    for (const std::size_t i : triangles_[n]) {
      const auto& corners = triangles_vx_[i];
      const sim::CutPolygon part = sim::cutToBox(corners, low, high);
      if (part.count < 3) continue;
      const CubeTriangle& triangle = world_.triangles[i];
      const Ink ink{srgbFromLinear(triangle.colour), 1.0f};
      fill(std::span(part.corner).first(part.count), ink);
      for (std::size_t k = 0; k < 3; ++k) {  // where there is no border, paper would show between two fills
        const bool border = triangle.border[k];
        lineIn(corners[k], corners[(k + 1) % 3], low, high, border ? 1.5f * pen_ : 1.0f,
               border ? Ink{kPen, 1.0f} : ink);
      }
    }
    for (const std::size_t i : lines_[n])
      lineIn(lines_vx_[i][0], lines_vx_[i][1], low, high, 2.8f * pen_,
             {srgbFromLinear(world_.lines[i].colour), 1.0f});
  }

  void cube(const Cube& cube) {
    const Vec3 middle(cube.voxel), low = middle - 0.5, high = middle + 0.5;
    const sim::Colour body = glm::mix(srgbFromLinear(cube.colour), sim::Colour(1.0f), kPaler);
    const auto side = [&](bool front) {
      for (std::uint8_t face = 0; face < sim::kFaces; ++face) {
        if (taken_.at(cube.voxel + sim::kFaceNormals[face]) || faces(low, high, face) != front) continue;
        const bool below = sim::kFaceNormals[face].y < 0;
        const float light = below ? kLightBelow : kLightOnAxis[sim::faceAxis(face)];
        const auto corners = faceCorners(low, high, face);
        fill(corners, {light * body, front ? kFrontOpacity : kBackOpacity});
        outline(corners, front ? pen_ : 0.8f * pen_, {kPen, front ? 0.85f : kHiddenEdge});
      }
    };
    side(false);
    primitivesIn(cube);
    side(true);
  }

  const CubeWorld& world_;
  Projection projection_;
  double near_m_;
  Vec3 eye_vx_;
  float pen_;  // pixels
  Image picture_;
  sim::BitVolume taken_;
  std::vector<const Cube*> cubes_;                           // by voxel
  std::vector<std::vector<std::size_t>> triangles_, lines_;  // likewise
  std::vector<std::array<Vec3, 3>> triangles_vx_;
  std::vector<std::array<Vec3, 2>> lines_vx_;
};

}  // namespace

Image drawCubes(const CubeWorld& world, const Camera& camera, int width_px, int height_px) {
  return CubePainter(world, camera, width_px, height_px).draw();
}

}  // namespace espalier::render
