#include "sim/build_world.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>

#include "sim/error.h"
#include "sim/fill.h"
#include "sim/memory.h"
#include "sim/tile_mesh.h"
#include "sim/tiling.h"

namespace espalier::sim {
namespace {

/// The importer sees to this; a mesh that was made in code may have forgotten.
void requireSound(const Mesh& mesh) {
  const auto fail = [&](const char* what) {
    throw InputError(fmt::format("mesh '{}': {}", mesh.name, what));
  };
  const auto finite = [](Vec3 p) { return std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z); };
  const auto within = [](const std::vector<std::uint32_t>& indices, std::size_t count) {
    return std::all_of(indices.begin(), indices.end(), [&](std::uint32_t i) { return i < count; });
  };
  if (!std::all_of(mesh.vertices_m.begin(), mesh.vertices_m.end(), finite)) fail("a vertex is not finite");
  for (const auto& t : mesh.triangles) {
    if (std::max({t[0], t[1], t[2]}) >= mesh.vertices_m.size()) fail("a triangle's vertex does not exist");
  }
  if (mesh.region.size() != mesh.triangles.size() || !within(mesh.region, mesh.regions.size())) {
    fail("every triangle needs a region that exists");
  }
  if (mesh.material.size() != mesh.triangles.size() || !within(mesh.material, mesh.materials.size())) {
    fail("every triangle needs a material that exists");
  }
}

std::vector<std::array<Vec3, 3>> trianglesOf(const Mesh& mesh, const std::vector<Vec3>& vertices_vx) {
  constexpr double kFarthest = 16000;
  std::vector<std::array<Vec3, 3>> triangles;
  triangles.reserve(mesh.triangles.size());
  for (const auto& t : mesh.triangles) {
    triangles.push_back({vertices_vx[t[0]], vertices_vx[t[1]], vertices_vx[t[2]]});
    for (const Vec3& p : triangles.back()) {
      if (std::max({std::abs(p.x), std::abs(p.y), std::abs(p.z)}) < kFarthest) continue;
      throw InputError(
          fmt::format("mesh '{}': too large to fill, it reaches {} voxels beyond the world; expected "
                      "larger voxels, a smaller mesh, or a surface that is not filled",
                      mesh.name, kFarthest));
    }
  }
  return triangles;
}

/// The largest region's part and colour, for insides whose row shows no surface.
Surface largestRegion(const Mesh& mesh, PartId first_part) {
  std::vector<double> area(mesh.regions.size(), 0.0);
  std::vector<glm::dvec3> colour(mesh.regions.size(), glm::dvec3(0.0));
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    const auto& t = mesh.triangles[i];
    const Vec3& a = mesh.vertices_m[t[0]];
    const double size = glm::length(glm::cross(mesh.vertices_m[t[1]] - a, mesh.vertices_m[t[2]] - a));
    area[mesh.region[i]] += size;
    colour[mesh.region[i]] += size * glm::dvec3(mesh.materials[mesh.material[i]].colour);
  }
  const auto largest = static_cast<std::size_t>(std::max_element(area.begin(), area.end()) - area.begin());
  return {.part = first_part + static_cast<PartId>(largest),
          .colour = area[largest] > 0 ? Colour(colour[largest] / area[largest]) : Material{}.colour,
          .coverage = 1.0f,
          .normal = Vec3f(0.0f)};
}

/// The inside's voxels, each like the nearest surface voxel of its row along x, the lower one where two are
/// as near.
std::vector<TiledVoxel> insideVoxels(const BitVolume& inside, std::span<const TiledVoxel> surface,
                                     Surface fallback) {
  std::vector<TiledVoxel> voxels;
  auto row_begin = surface.begin();
  for (int y = 0; y < inside.size().y; ++y) {
    for (int z = 0; z < inside.size().z; ++z) {
      const auto row_end = std::find_if(
          row_begin, surface.end(), [&](const TiledVoxel& t) { return t.voxel.y != y || t.voxel.z != z; });
      auto next = row_begin;
      for (int i = 0; i < inside.rowWords(); ++i) {
        for (std::uint64_t word = inside.row(y, z)[i]; word != 0; word &= word - 1) {
          const int x = i * BitVolume::kWordBits + std::countr_zero(word);
          while (next != row_end && next->voxel.x < x) ++next;
          Surface like = fallback;
          if (next != row_begin && (next == row_end || x - (next - 1)->voxel.x <= next->voxel.x - x)) {
            like = (next - 1)->surface;
          } else if (next != row_end) {
            like = next->surface;
          }
          voxels.push_back({Voxel(x, y, z), {like.part, like.colour, 1.0f, Vec3f(0.0f)}});
        }
      }
      row_begin = row_end;
    }
  }
  return voxels;
}

/// Earlier meshes keep their voxels.
void keepFree(BitVolume& voxels, const BitVolume& occupied) {
  for (int y = 0; y < voxels.size().y; ++y) {
    for (int z = 0; z < voxels.size().z; ++z) {
      for (int i = 0; i < voxels.rowWords(); ++i) voxels.row(y, z)[i] &= ~occupied.row(y, z)[i];
    }
  }
}

FillReport fill(World& world, const Mesh& mesh, const std::vector<Vec3>& vertices_vx,
                std::span<const TiledVoxel> surface, PartId first_part) {
  BitVolume tiled(world.frame().size);
  for (const TiledVoxel& t : surface) tiled.set(t.voxel);
  Inside inside = findInside(trianglesOf(mesh, vertices_vx), tiled);
  keepFree(inside.voxels, world.occupied());
  const std::size_t count = inside.voxels.count();
  requireFilledFits(count, mesh.name);
  world.occupy(insideVoxels(inside.voxels, surface, largestRegion(mesh, first_part)));
  return {mesh.name, count, inside.doubtful};
}

}  // namespace

World buildWorld(const Frame& frame, const std::vector<TiledMesh>& meshes, int layers,
                 std::vector<FillReport>* fills) {
  requireFits(frame);
  for (const TiledMesh& m : meshes) requireSound(m.mesh);
  World world(frame);
  for (const auto& [mesh, solid] : meshes) {
    const auto first_part = static_cast<PartId>(world.parts().size() + 1);
    for (const std::string& region : mesh.regions) world.addPart({.object = mesh.name, .region = region});
    std::vector<Vec3> vertices_vx(mesh.vertices_m.size());
    std::transform(mesh.vertices_m.begin(), mesh.vertices_m.end(), vertices_vx.begin(),
                   [&](Vec3 p) { return voxelFromWorld(frame, p); });
    const std::vector<TiledVoxel> surface = tileMesh(mesh, vertices_vx, frame.size, first_part);
    world.occupy(surface);
    if (!solid || mesh.triangles.empty()) continue;
    const FillReport report = fill(world, mesh, vertices_vx, surface, first_part);
    if (fills != nullptr) fills->push_back(report);
  }
  world.setLayers(layers);
  return world;
}

Frame frameAround(const std::vector<TiledMesh>& meshes, double voxel_m, double margin_m) {
  if (!(voxel_m > 0) || !std::isfinite(voxel_m)) {
    throw InputError(fmt::format("voxel size {} m: expected a positive length", voxel_m));
  }
  if (!(margin_m >= 0) || !std::isfinite(margin_m)) {
    throw InputError(fmt::format("margin {} m: expected zero or a positive length", margin_m));
  }
  Vec3 low(std::numeric_limits<double>::infinity());
  Vec3 high = -low;
  for (const TiledMesh& m : meshes) {
    requireSound(m.mesh);
    for (const auto& t : m.mesh.triangles) {
      for (const std::uint32_t i : t) {
        low = glm::min(low, m.mesh.vertices_m[i]);
        high = glm::max(high, m.mesh.vertices_m[i]);
      }
    }
  }
  if (low.x > high.x)
    throw InputError("the meshes hold no triangle, so there is nothing to lay a world around");
  const Vec3 origin = low - margin_m + voxel_m / 2;
  // A face that lies exactly between two layers is tiled in the upper one, so the last voxel is that of the
  // high corner. A thousandth of a voxel more than whole ones is rounding.
  const Vec3 last = glm::floor((high - origin) / voxel_m + 0.5 + 0.5 / static_cast<double>(kFixedOne));
  const Vec3 with_margin = glm::ceil((high - low + 2 * margin_m) / voxel_m - 1e-3);
  const Vec3 size = glm::max(last + 1.0, with_margin);
  requireFits(size, voxel_m);
  return {.origin_m = origin, .voxel_m = voxel_m, .size = Voxel(size)};
}

}  // namespace espalier::sim
