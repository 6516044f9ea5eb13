#include "sim/tile/build_world.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <span>

#include "sim/base/error.h"
#include "sim/base/parallel.h"
#include "sim/base/stop.h"
#include "sim/tile/clip.h"
#include "sim/tile/closed.h"
#include "sim/tile/fill.h"
#include "sim/tile/memory.h"
#include "sim/tile/tile_lines.h"
#include "sim/tile/tile_mesh.h"
#include "sim/tile/tiling.h"

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

std::vector<Vec3> verticesIn(const Frame& frame, const Mesh& mesh) {
  constexpr double kFarthest = 1e12;  // beyond it a double no longer tells fractions of a voxel apart
  std::vector<Vec3> vertices_vx;
  vertices_vx.reserve(mesh.vertices_m.size());
  for (const Vec3& p : mesh.vertices_m) {
    const Vec3 q = voxelFromWorld(frame, p);
    if (!(std::max({std::abs(q.x), std::abs(q.y), std::abs(q.z)}) < kFarthest)) {
      throw InputError(
          fmt::format("mesh '{}': a vertex lies more than {:g} voxels from the world; expected larger "
                      "voxels or another unit of length",
                      mesh.name, kFarthest));
    }
    vertices_vx.push_back(q);
  }
  return vertices_vx;
}

/// Those that fixed point cannot hold are cut to the world, which would open a solid.
Triangles trianglesOf(const TiledMesh& tiled, const std::vector<Vec3>& vertices_vx, Voxel size) {
  Triangles triangles;
  triangles.reserve(tiled.mesh.triangles.size());
  for (const auto& t : tiled.mesh.triangles) {
    const std::array<Vec3, 3> corners{vertices_vx[t[0]], vertices_vx[t[1]], vertices_vx[t[2]]};
    const bool far = std::any_of(corners.begin(), corners.end(), [](const Vec3& p) {
      return !(std::max({std::abs(p.x), std::abs(p.y), std::abs(p.z)}) < kFarthestCorner);
    });
    if (!far) {
      triangles.push_back(corners);
    } else if (tiled.solid) {
      throw InputError(
          fmt::format("mesh '{}': too large to fill, it reaches {} voxels beyond the world; expected "
                      "larger voxels, a smaller mesh, or a surface that is not filled",
                      tiled.mesh.name, kFarthestCorner));
    } else {
      const CutPolygon polygon = cutToBox(corners, Vec3(-2.0), Vec3(size) + 1.0);
      for (std::size_t i = 2; i < polygon.count; ++i)
        triangles.push_back({polygon.corner[0], polygon.corner[i - 1], polygon.corner[i]});
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

/// Those of a solid's inside voxels that fill blocks of 8x8x8 whole: a byte of all ones for each, by rows of
/// blocks. Blocks at the world's high edges that are cut off do not count.
class WholeBlocks {
 public:
  WholeBlocks(const BitVolume& inside, int block_y)
      : z_rows_(inside.size().z / 8), words_(inside.rowWords()) {
    if (8 * block_y + 8 > inside.size().y) z_rows_ = 0;
    masks_.assign(static_cast<std::size_t>(z_rows_) * static_cast<std::size_t>(words_), 0);
    parallelForEach(static_cast<std::size_t>(z_rows_), [&](std::size_t block_z) {
      for (int i = 0; i < words_; ++i) {
        std::uint64_t all = ~std::uint64_t{0};
        for (int row = 0; row < 64 && all != 0; ++row)
          all &= inside.row(8 * block_y + row / 8, 8 * static_cast<int>(block_z) + row % 8)[i];
        std::uint64_t whole = 0;
        for (int byte = 0; byte < 8; ++byte) {
          const std::uint64_t ones = std::uint64_t{0xff} << (8 * byte);
          if ((all & ones) == ones) whole |= ones;
        }
        masks_[block_z * static_cast<std::size_t>(words_) + static_cast<std::size_t>(i)] = whole;
      }
    });
  }
  std::uint64_t mask(int z, int word) const {
    return z / 8 < z_rows_ ? masks_[static_cast<std::size_t>(z / 8) * static_cast<std::size_t>(words_) +
                                    static_cast<std::size_t>(word)]
                           : 0;
  }

 private:
  int z_rows_, words_;
  std::vector<std::uint64_t> masks_;
};

/// Occupies a solid's inside: its voxels are like the nearest surface voxel of their row along x, the lower
/// one where two are as near. Whole blocks are all like their first voxel, as nobody sees so deep.
void occupyInside(World& world, const BitVolume& inside, std::span<const TiledVoxel> surface,
                  const Surface& fallback) {
  const Voxel size = inside.size();
  auto row_begin = surface.begin();
  std::vector<TiledVoxel> voxels, blocks;
  for (int block_y = 0; 8 * block_y < size.y; ++block_y) {
    throwIfStopped();
    const WholeBlocks whole(inside, block_y);
    for (int y = 8 * block_y; y < std::min(8 * block_y + 8, size.y); ++y) {
      for (int z = 0; z < size.z; ++z) {
        const auto row_end = std::find_if(
            row_begin, surface.end(), [&](const TiledVoxel& t) { return t.voxel.y != y || t.voxel.z != z; });
        auto next = row_begin;
        const auto like = [&](int x) {
          while (next != row_end && next->voxel.x < x) ++next;
          Surface s = fallback;
          if (next != row_begin && (next == row_end || x - (next - 1)->voxel.x <= next->voxel.x - x)) {
            s = (next - 1)->surface;
          } else if (next != row_end) {
            s = next->surface;
          }
          return Surface{.part = s.part, .colour = s.colour, .coverage = 1.0f};
        };
        const bool first_row = y % 8 == 0 && z % 8 == 0;
        for (int i = 0; i < inside.rowWords(); ++i) {
          const std::uint64_t in_blocks = whole.mask(z, i);
          std::uint64_t word = inside.row(y, z)[i] & ~in_blocks;
          if (first_row) word |= in_blocks & 0x0101010101010101u;
          for (; word != 0; word &= word - 1) {
            const int bit = std::countr_zero(word);
            const Voxel v(i * BitVolume::kWordBits + bit, y, z);
            ((in_blocks >> bit & 1u) != 0 ? blocks : voxels).push_back({v, like(v.x)});
          }
        }
        row_begin = row_end;
      }
    }
    world.occupyClear(voxels);
    world.occupyBlocks(blocks);
    voxels.clear();
    blocks.clear();
  }
}

/// Those that occupyInside keeps one by one.
std::size_t singleVoxels(const BitVolume& inside) {
  std::size_t count = 0;
  for (int block_y = 0; 8 * block_y < inside.size().y; ++block_y) {
    const WholeBlocks whole(inside, block_y);
    for (int y = 8 * block_y; y < std::min(8 * block_y + 8, inside.size().y); ++y) {
      for (int z = 0; z < inside.size().z; ++z) {
        for (int i = 0; i < inside.rowWords(); ++i)
          count += static_cast<std::size_t>(std::popcount(inside.row(y, z)[i] & ~whole.mask(z, i)));
      }
    }
  }
  return count;
}

/// Earlier meshes keep their voxels.
void keepFree(BitVolume& voxels, const BitVolume& occupied) {
  for (int y = 0; y < voxels.size().y; ++y) {
    for (int z = 0; z < voxels.size().z; ++z) {
      for (int i = 0; i < voxels.rowWords(); ++i) voxels.row(y, z)[i] &= ~occupied.row(y, z)[i];
    }
  }
}

/// Turns normals that point into the solid: real meshes are inside out, as a whole or in part.
void faceOutwards(std::vector<TiledVoxel>& surface, const BitVolume& solid) {
  for (auto& [voxel, s] : surface) {
    const Voxel ahead = voxelAt(Vec3(s.normal * (s.offset_vx + 1.0f)));
    const Voxel behind = voxelAt(Vec3(s.normal * (s.offset_vx - 1.0f)));
    if (!solid.at(voxel + ahead) || solid.at(voxel + behind)) continue;
    s.normal = -s.normal;
    s.offset_vx = -s.offset_vx;
  }
}

/// The mesh wound as it faces.
Mesh asItFaces(const TiledMesh& tiled) {
  Mesh mesh = tiled.mesh;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    if (tiled.turned[t]) std::swap(mesh.triangles[t][1], mesh.triangles[t][2]);
  }
  return mesh;
}

/// Puts what takes no light into the world: lines are too thin for it, and guides are not there.
void addOpen(World& world, const std::vector<TiledVoxel>& surface, bool guide) {
  guide ? world.addGuide(surface) : world.occupyClear(surface);
}

/// Puts a mesh into the world; what was found out where it is filled.
FillReport add(World& world, const TiledMesh& tiled, PartId first_part) {
  const Mesh& mesh = tiled.mesh;
  if (!tiled.lines.empty()) {
    addOpen(world, tileLines(tiled, world.frame(), first_part), tiled.guide);
    return {};
  }
  const std::vector<Vec3> vertices_vx = verticesIn(world.frame(), mesh);
  std::vector<TiledVoxel> surface = tileMesh(mesh, vertices_vx, world.frame().size, first_part);
  if (tiled.guide) {
    addOpen(world, surface, true);
    return {};
  }
  BitVolume touched(world.frame().size);
  for (const TiledVoxel& t : surface) touched.set(t.voxel);
  const Triangles triangles = trianglesOf(tiled, vertices_vx, world.frame().size);
  const bool finds = tiled.where_closed && !tiled.solid;
  Filled filled = finds ? fillMesh(triangles, touched, enclosedBy(triangles, touched))
                        : fillMesh(triangles, touched, tiled.solid);
  if (tiled.shade) world.addOpaque(filled.opaque);
  if (tiled.solid || finds) faceOutwards(surface, filled.opaque);
  world.occupyClear(surface);
  if (!tiled.solid && !finds) return {};
  keepFree(filled.inside, world.occupied());
  requireFilledFits(singleVoxels(filled.inside), mesh.name);
  occupyInside(world, filled.inside, surface, largestRegion(mesh, first_part));
  return {mesh.name, filled.inside.count(), filled.doubtful, finds};
}

}  // namespace

World buildWorld(const Frame& frame, const std::vector<TiledMesh>& meshes, int layers,
                 std::vector<FillReport>* fills) {
  requireFits(frame, {.layers = layers});
  for (const TiledMesh& m : meshes) {
    requireSound(m.mesh);
    if (!m.turned.empty() && m.turned.size() != m.mesh.triangles.size())
      throw InputError(fmt::format("mesh '{}': every triangle needs a side to face", m.mesh.name));
  }
  World world(frame);
  for (const TiledMesh& m : meshes) {
    const auto first_part = static_cast<PartId>(world.parts().size() + 1);
    for (const std::string& region : m.mesh.regions) world.addPart({.object = m.mesh.name, .region = region});
    if (m.mesh.triangles.empty() && m.lines.empty()) continue;
    const FillReport report =
        m.turned.empty() || !m.lit()
            ? add(world, m, first_part)
            : add(world, {asItFaces(m), m.solid, m.where_closed, {}, {}, m.guide, m.shade}, first_part);
    if (report.found && report.filled > 0) world.setFoundClosed(m.mesh.name);
    if (fills != nullptr && (m.solid || report.filled > 0)) fills->push_back(report);
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
    for (const Line& line : m.lines) {
      low = glm::min(low, glm::min(line.from_m, line.to_m));
      high = glm::max(high, glm::max(line.from_m, line.to_m));
    }
  }
  if (low.x > high.x)
    throw InputError("the meshes hold no triangle and no line, so there is nothing to lay a world around");
  const Vec3 origin = low - margin_m + voxel_m / 2;
  // A face that lies exactly between two layers is tiled in the upper one, so the last voxel is that of the
  // high corner. A thousandth of a voxel more than whole ones is rounding.
  const Vec3 last = glm::floor((high - origin) / voxel_m + 0.5 + 0.5 / static_cast<double>(kFixedOne));
  const Vec3 with_margin = glm::ceil((high - low + 2 * margin_m) / voxel_m - 1e-3);
  const Vec3 size = glm::max(last + 1.0, with_margin);
  requireFits(size, voxel_m, {});
  return {.origin_m = origin, .voxel_m = voxel_m, .size = Voxel(size)};
}

}  // namespace espalier::sim
