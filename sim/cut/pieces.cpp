#include "sim/cut/pieces.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "sim/base/counted.h"
#include "sim/base/error.h"
#include "sim/base/frame.h"
#include "sim/base/memory.h"
#include "sim/base/parallel.h"
#include "sim/cut/level_set.h"
#include "sim/cut/parts.h"
#include "sim/cut/sheets.h"
#include "sim/tile/inside.h"

namespace espalier::sim {
namespace {

constexpr int kRim = 5;                      // voxels around the solid
constexpr double kOnSurface_vx = 0.75;       // nearer to the solid's own surface: a face of it
constexpr double kMostVoxelsAlong = 15'000;  // more than solids can be filled with

InputError wrong(const Mesh& solid, const std::string& what) {
  return InputError(fmt::format("mesh '{}': {}", solid.name, what));
}

struct Box {
  Vec3 low{INFINITY}, high{-INFINITY};
};

Box boxOf(const Mesh& mesh) {
  Box box;
  for (const auto& t : mesh.triangles) {
    for (const std::uint32_t v : t) {
      box.low = glm::min(box.low, mesh.vertices_m[v]);
      box.high = glm::max(box.high, mesh.vertices_m[v]);
    }
  }
  return box;
}

double areaOf(const Mesh& mesh) {
  double area = 0.0;
  for (const auto& [a, b, c] : mesh.triangles) {
    const Vec3 &p = mesh.vertices_m[a], &q = mesh.vertices_m[b], &r = mesh.vertices_m[c];
    area += 0.5 * glm::length(glm::cross(q - p, r - p));
  }
  return area;
}

/// Bytes by voxels in the box, by squares of voxels of the solid's surface, and by blocks along the sheets.
double bytesFor(double voxels, double squares, double blocks) {
  constexpr double kBox = 0.5, kSquare = 900.0, kBlockBytes = 20'000.0;
  return kBox * voxels + kSquare * squares + kBlockBytes * blocks;
}

/// Of a triangle of a piece: which of the solid's triangles it is of.
class Origins {
 public:
  Origins(const Mesh& solid, const LevelSet& level_set) : solid_(solid), level_set_(level_set) {}

  /// kLaidBare: none.
  std::uint32_t of(Vec3 middle_vx) const {
    if (std::abs(level_set_.distanceAt(middle_vx)) > kOnSurface_vx) return kLaidBare;
    const std::int32_t nearest = level_set_.nearestAt(middle_vx);
    return nearest < 0 || static_cast<std::size_t>(nearest) >= solid_.triangles.size()
               ? 0
               : static_cast<std::uint32_t>(nearest);
  }
  static constexpr std::uint32_t kLaidBare = std::numeric_limits<std::uint32_t>::max();

 private:
  const Mesh& solid_;
  const LevelSet& level_set_;
};

/// UVs as a triangle's plane carries them on, so that what lies beside an edge of it has them without a seam.
glm::vec2 carriedUv(const Mesh& solid, std::uint32_t triangle, Vec3 p_m) {
  const auto& [a, b, c] = solid.triangles[triangle];
  const Vec3 from = solid.vertices_m[a], u = solid.vertices_m[b] - from, v = solid.vertices_m[c] - from;
  const double uu = glm::dot(u, u), uv = glm::dot(u, v), vv = glm::dot(v, v), area2 = uu * vv - uv * uv;
  if (!(area2 > 0.0)) return solid.uvs[a];
  const double pu = glm::dot(p_m - from, u), pv = glm::dot(p_m - from, v);
  const auto s = static_cast<float>((pu * vv - pv * uv) / area2),
             t = static_cast<float>((pv * uu - pu * uv) / area2);
  return solid.uvs[a] + s * (solid.uvs[b] - solid.uvs[a]) + t * (solid.uvs[c] - solid.uvs[a]);
}

Piece pieceOf(const ClosedPart& part, const Mesh& solid, const Frame& frame, const Origins& origins,
              Colour inside, std::size_t number) {
  Piece piece;
  const double voxel_m3 = frame.voxel_m * frame.voxel_m * frame.voxel_m;
  piece.volume_m3 = part.volume * voxel_m3;
  piece.middle_m = worldFromVoxel(frame, part.middle);
  Mesh& mesh = piece.mesh;
  mesh.name = fmt::format("{}_{}", solid.name, number);
  mesh.regions = {mesh.name};
  mesh.region.assign(part.triangles.size(), 0);
  mesh.materials = solid.materials;
  Material& bare = mesh.materials.emplace_back();
  bare.name = "inside";
  bare.colour = inside;
  const bool carries = !solid.uvs.empty();
  mesh.triangles = part.triangles;
  mesh.material.reserve(part.triangles.size());
  if (!carries) {
    mesh.vertices_m.reserve(part.points.size());
    for (const Vec3& p : part.points) mesh.vertices_m.push_back(worldFromVoxel(frame, p));
  }
  for (auto& triangle : mesh.triangles) {
    const auto [a, b, c] = triangle;
    const std::uint32_t origin = origins.of((part.points[a] + part.points[b] + part.points[c]) / 3.0);
    const bool laid_bare = origin == Origins::kLaidBare;
    mesh.material.push_back(laid_bare ? static_cast<std::uint32_t>(solid.materials.size())
                                      : solid.material[origin]);
    if (!carries) continue;
    for (std::uint32_t& corner : triangle) {
      const Vec3 p_m = worldFromVoxel(frame, part.points[corner]);
      corner = static_cast<std::uint32_t>(mesh.vertices_m.size());
      mesh.vertices_m.push_back(p_m);
      mesh.uvs.push_back(laid_bare ? glm::vec2(0.0f) : carriedUv(solid, origin, p_m));
    }
  }
  return piece;
}

/// The voxels of a level set in which the solid is cut.
Frame frameOf(const Mesh& solid, double voxel_m) {
  const Box box = boxOf(solid);
  const Vec3 across = (box.high - box.low) / voxel_m;
  const double longest = std::max({across.x, across.y, across.z});
  if (!(longest > 0.0) || !std::isfinite(longest)) throw wrong(solid, "has no inside; expected a closed one");
  if (longest > kMostVoxelsAlong)
    throw wrong(solid,
                fmt::format("is {:.3g} voxels of {:.3g} m long; expected at most {:.0f}: a voxel of at "
                            "least {:.2g} m, and a kerf of twice that",
                            longest, voxel_m, kMostVoxelsAlong, voxel_m * longest / kMostVoxelsAlong));
  return {box.low - kRim * voxel_m, voxel_m, Voxel(glm::ceil(across)) + 2 * kRim + 1};
}

void requireSound(const Mesh& solid) {
  if (const OpenEdges open = openEdgesOf(solid); open.count > 0)
    throw wrong(solid, fmt::format("is not closed: {} of it {} no neighbour, the first at [{:.4g}, {:.4g}, "
                                   "{:.4g}] m; expected a solid without holes",
                                   counted(open.count, "edge"), open.count == 1 ? "has" : "have", open.at_m.x,
                                   open.at_m.y, open.at_m.z));
}

/// Voxels in the box, and squares of voxels of the solid's surface.
struct Extent {
  double voxels, squares;
};

Extent extentOf(const Mesh& solid, const Frame& frame) {
  const Vec3 size(frame.size);
  return {size.x * size.y * size.z, areaOf(solid) / (frame.voxel_m * frame.voxel_m)};
}

void requireFits(const Mesh& solid, const Frame& frame, double blocks) {
  const Extent extent = extentOf(solid, frame);
  const double bytes = bytesFor(extent.voxels, extent.squares, blocks);
  const double free = std::max(0.0, memoryBudget() - memoryInUse());
  if (bytes <= free) return;
  throw wrong(solid,
              fmt::format("cut with voxels of {:.3g} m it needs {} of memory, and {} are free for it here; "
                          "expected a voxel of at least {:.2g} m, and a kerf of at least twice that",
                          frame.voxel_m, inGigabytes(bytes), inGigabytes(free),
                          frame.voxel_m * std::sqrt(bytes / std::max(free, 1.0))));
}

}  // namespace

void requireCuttable(const Mesh& solid, const CutSettings& settings) {
  const double voxel_m = settings.voxel_m;
  if (!(settings.kerf_m >= kLeastKerf_vx * voxel_m * (1.0 - 1e-9)))
    throw wrong(solid,
                fmt::format("a kerf of {:.3g} m is less than {:.0f} voxels of {:.3g} m, which show it; "
                            "expected a kerf of at least {:.3g} m, or a voxel of at most {:.3g} m",
                            settings.kerf_m, kLeastKerf_vx, voxel_m, kLeastKerf_vx * voxel_m,
                            settings.kerf_m / kLeastKerf_vx));
  requireFits(solid, frameOf(solid, voxel_m), 0.0);
  requireSound(solid);
}

Pieces cutSolid(const Mesh& solid, std::span<const CutLine> lines, const CutSettings& settings) {
  requireCuttable(solid, settings);
  const double voxel_m = settings.voxel_m;
  const Frame frame = frameOf(solid, voxel_m);
  const double half_kerf = 0.5 * settings.kerf_m / voxel_m;
  std::vector<Sheet> sheets;
  sheets.reserve(lines.size());
  for (const CutLine& line : lines) {
    const Vec3 from = voxelFromWorld(frame, line.from_m);
    sheets.push_back({from, voxelFromWorld(frame, line.to_m) - from, settings.sweep_m / voxel_m});
  }
  std::optional<Straying> straying;
  double strays = 0.0;
  if (settings.rough && settings.rough->amplitude_m > 0.0) {
    straying.emplace(settings.rough->amplitude_m / voxel_m, settings.rough->over_m / voxel_m,
                     std::max(2.0 * half_kerf, 4.0), settings.stream);
    strays = std::sqrt(3.0) * straying->farthest();
  }
  const auto near = blocksNear(sheets, half_kerf + LevelSet::kBand_vx + strays, Voxel(0), frame.size - 1);
  requireFits(solid, frame, static_cast<double>(near.size()));

  Pieces result;
  std::vector<Vec3> corners;
  corners.reserve(solid.vertices_m.size());
  for (const Vec3& p : solid.vertices_m) corners.push_back(voxelFromWorld(frame, p));
  const BitVolume inside = insideOf(solid, frame);
  result.voxels = inside.count();
  LevelSet level_set(corners, solid.triangles, inside);
  const double voxel_m3 = voxel_m * voxel_m * voxel_m;
  for (const ClosedPart& part : partsOf(level_set.surface())) result.solid_m3 += part.volume * voxel_m3;
  if (!(result.solid_m3 > 0.0))
    throw wrong(solid, fmt::format("holds nothing that voxels of {:.3g} m show; expected smaller ones, or a "
                                   "solid that is thicker",
                                   voxel_m));
  std::function<Vec3(Vec3)> strayed;
  if (straying) strayed = [&](Vec3 p) { return (*straying)(p - Vec3(kRim)); };
  level_set.cut(near, sheets, half_kerf, strayed);

  const Origins origins(solid, level_set);
  std::vector<ClosedPart> kept;
  for (ClosedPart& part : partsOf(level_set.surface())) {
    const double volume_m3 = part.volume * voxel_m3;
    if (volume_m3 >= settings.least_share * result.solid_m3) {
      kept.push_back(std::move(part));
      continue;
    }
    ++result.crumbs;
    result.crumbs_m3 += volume_m3;
  }
  if (kept.empty())
    throw wrong(solid,
                fmt::format("nothing is left of it, or crumbs alone; expected a kerf of less than {:.3g} "
                            "m, fewer limbs, or a smaller least share",
                            settings.kerf_m));
  result.pieces.resize(kept.size());
  parallelForEach(kept.size(), [&](std::size_t i) {
    result.pieces[i] = pieceOf(kept[i], solid, frame, origins, settings.inside, i + 1);
  });
  double sum_m3 = 0.0;
  for (const Piece& piece : result.pieces) {
    sum_m3 += piece.volume_m3;
    result.middle_m += piece.volume_m3 * piece.middle_m;
  }
  if (sum_m3 > 0.0) result.middle_m /= sum_m3;
  return result;
}

}  // namespace espalier::sim
