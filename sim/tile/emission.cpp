#include "sim/tile/emission.h"

#include <algorithm>
#include <map>

#include "sim/tile/clip.h"
#include "sim/tile/tiling.h"

namespace espalier::sim {
namespace {

struct InRows {
  bool operator()(Voxel a, Voxel b) const { return beforeInRows(a, b); }
};

struct Sent {
  double area = 0.0;  ///< over that of a face
  glm::dvec3 light{0.0};
};

double areaOf(const CutPolygon& polygon) {
  Vec3 twice(0.0);
  for (std::size_t i = 2; i < polygon.count; ++i)
    twice += glm::cross(polygon.corner[i - 1] - polygon.corner[0], polygon.corner[i] - polygon.corner[0]);
  return 0.5 * glm::length(twice);
}

void add(const std::array<Vec3, 3>& corners, Colour light, Voxel size, std::map<Voxel, Sent, InRows>& to) {
  // What lies far outside cannot be tiled.
  const CutPolygon inside = cutToBox(corners, Vec3(-1.0), Vec3(size));
  std::vector<Voxel> voxels;
  for (std::size_t i = 2; i < inside.count; ++i)
    tileTriangle({inside.corner[0], inside.corner[i - 1], inside.corner[i]}, voxels);
  std::sort(voxels.begin(), voxels.end(), beforeInRows);
  voxels.erase(std::unique(voxels.begin(), voxels.end()), voxels.end());
  for (const Voxel v : voxels) {
    if (!contains(size, v)) continue;
    const double area = areaOf(cutToBox(corners, Vec3(v) - 0.5, Vec3(v) + 0.5));
    Sent& sent = to[v];
    sent.area += area;
    sent.light += area * glm::dvec3(light);
  }
}

}  // namespace

std::vector<EmittingVoxel> emissionOf(const Frame& frame, std::span<const TiledMesh> meshes,
                                      const std::function<float(Voxel)>& covered) {
  std::map<Voxel, Sent, InRows> sent;
  for (const TiledMesh& tiled : meshes) {
    const Mesh& mesh = tiled.mesh;
    for (std::size_t i = 0; !tiled.guide && i < mesh.triangles.size(); ++i) {
      const Colour light = mesh.materials[mesh.material[i]].emissive;
      if (light == Colour(0.0f)) continue;
      std::array<Vec3, 3> corners;
      for (std::size_t k = 0; k < 3; ++k)
        corners[k] = voxelFromWorld(frame, mesh.vertices_m[mesh.triangles[i][k]]);
      add(corners, light, frame.size, sent);
    }
  }
  std::vector<EmittingVoxel> voxels;
  for (const auto& [voxel, of] : sent) {
    const double all = std::max<double>(of.area, covered(voxel));
    if (all > 0.0) voxels.push_back({voxel, Colour(of.light / all)});
  }
  return voxels;
}

}  // namespace espalier::sim
