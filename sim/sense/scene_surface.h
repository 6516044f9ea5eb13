#pragma once
#include <array>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <unordered_map>
#include <utility>
#include <vector>

#include "sim/base/vec.h"
#include "sim/sense/crossing.h"
#include "sim/tile/build_world.h"

/// The surfaces of a scene's meshes, exactly: what lies on them stands where they are, where voxels tell
/// places apart by a width at best.
namespace espalier::sim {

struct SurfaceTriangle {
  std::array<Vec3, 3> corners_vx;
  std::uint32_t region = 0;  ///< of SceneSurface::regions
};

/// Triangles by place. Const members may be called from any number of threads.
class SceneSurface {
 public:
  /// Of triangles that reach into a world of this size; what lies outside of it is not found. `regions`: the
  /// names that they refer to. Throws BrokenContract for a region that has none.
  SceneSurface(Voxel size, const std::vector<SurfaceTriangle>& triangles, std::vector<std::string> regions);

  struct Triangle {
    std::array<Vec3, 3> corners_vx;
    Vec3 normal{0.0};  ///< unit, as it is wound
    std::uint32_t region = 0;
  };
  /// Those that have an area and touch the world.
  const std::vector<Triangle>& triangles() const { return triangles_; }
  const std::vector<std::string>& regions() const { return regions_; }

  struct Place {
    Vec3 at_vx{0.0};
    std::uint32_t triangle = 0;
  };
  using Wanted = std::function<bool(const Triangle&)>;
  /// The nearest place of the surfaces, of those triangles that are wanted, if one is nearer than
  /// `within_vx`; of equally near ones that of the first triangle.
  std::optional<Place> nearest(Vec3 at_vx, double within_vx, const Wanted& wanted) const;
  /// The triangles whose boxes meet one, each once, in their order. Replaces what `found` held.
  void trianglesIn(const LatticeBox& box, std::vector<std::uint32_t>& found) const;

 private:
  struct Ball {
    Vec3 middle_vx{0.0};
    double radius_vx = 0.0;
  };

  std::optional<Place> nearestOf(Vec3 at_vx, double within_vx, const Wanted& wanted) const;
  void list(std::uint32_t number, const std::array<Vec3, 3>& part);
  std::uint64_t keyOf(Voxel cell) const;

  Voxel cells_;
  std::vector<Triangle> triangles_;
  std::vector<Ball> balls_;  // that hold them
  std::vector<std::string> regions_;
  std::vector<std::pair<std::uint64_t, std::uint32_t>> listed_;  // cell and triangle, sorted
  std::unordered_map<std::uint64_t, std::pair<std::uint32_t, std::uint32_t>> in_cell_;  // from, to in listed_
};

/// Of all meshes that stand in the way of something, in voxel space. Regions of one name are one.
std::shared_ptr<const SceneSurface> surfaceOf(const Frame& frame, const std::vector<TiledMesh>& meshes);

/// The point of a triangle that is nearest to a place.
Vec3 nearestOn(const std::array<Vec3, 3>& corners, Vec3 at);

}  // namespace espalier::sim
