// The divergence theorem: the volume of a body in a row of voxels, from x0 on to x0 + 1, is the flux of
// clamp(x - x0, 0, 1) along x out of it, for the row's sides are along x and nothing flows through them. So
// each voxel of a row needs what the surface's pieces in it show along x, with their sides (`across`), and
// the sum of this over all pieces farther along; nothing is cut but triangles.
#include "sim/tile/occupancy.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "sim/base/error.h"
#include "sim/base/parallel.h"
#include "sim/base/stop.h"
#include "sim/tile/clip.h"

namespace espalier::sim {
namespace {

/// What the pieces of a surface in a voxel sum up to; a face has area 1.
struct Flux {
  double across = 0.0;  ///< their areas seen along x; above 0 where they face +x
  double moment = 0.0;  ///< the same, each times how far it lies from the voxel's low face along x
  double area = 0.0;
};

/// A mesh measured from the low corner of voxel (0, 0, 0), with the numbers of its triangles by layer.
struct Layered {
  const TiledMesh* tiled = nullptr;
  PartId first_part = kFree;
  bool fills = false;  ///< what it encloses
  double thickness_vx = 0.0;
  std::vector<Vec3> vertices_vx = {};
  std::vector<std::vector<std::uint32_t>> layers = {};
  int first_z = 0, last_z = -1;  ///< rows of the world that it may meet

  bool owns(PartId part) const {
    return part >= first_part && part < first_part + static_cast<PartId>(tiled->mesh.regions.size());
  }
};

int cellAlong(double from_corner) {
  return static_cast<int>(std::floor(from_corner));
}

Layered layered(const World& world, const TiledMesh& tiled, PartId first_part, double thickness_vx) {
  const Frame& frame = world.frame();
  const bool closed = tiled.where_closed && world.part(first_part).found_closed;
  Layered mesh{&tiled, first_part, tiled.solid || closed || !tiled.lines.empty(), thickness_vx};
  double low_z = frame.size.z, high_z = 0.0;
  for (const Vec3& p : tiled.mesh.vertices_m) {
    mesh.vertices_vx.push_back(voxelFromWorld(frame, p) + 0.5);
    low_z = std::min(low_z, mesh.vertices_vx.back().z);
    high_z = std::max(high_z, mesh.vertices_vx.back().z);
  }
  mesh.first_z = cellAlong(std::max(low_z, 0.0));
  mesh.last_z = cellAlong(std::min(high_z, frame.size.z - 0.5));
  mesh.layers.resize(static_cast<std::size_t>(frame.size.y));
  for (std::size_t i = 0; i < tiled.mesh.triangles.size(); ++i) {
    const auto& t = tiled.mesh.triangles[i];
    const auto [low, high] =
        std::minmax({mesh.vertices_vx[t[0]].y, mesh.vertices_vx[t[1]].y, mesh.vertices_vx[t[2]].y});
    if (high < 0.0 || low >= frame.size.y) continue;
    const int last = std::min(cellAlong(std::min(high, 1e9)), frame.size.y - 1);
    for (int y = cellAlong(std::max(low, 0.0)); y <= last; ++y)
      mesh.layers[static_cast<std::size_t>(y)].push_back(static_cast<std::uint32_t>(i));
  }
  return mesh;
}

std::pair<double, double> boundsAlong(const CutPolygon& polygon, int axis) {
  double low = polygon.corner[0][axis], high = low;
  for (std::size_t i = 1; i < polygon.count; ++i) {
    low = std::min(low, polygon.corner[i][axis]);
    high = std::max(high, polygon.corner[i][axis]);
  }
  return {low, high};
}

void add(Flux& flux, const CutPolygon& piece, int x) {
  Vec3 twice(0.0);
  for (std::size_t i = 2; i < piece.count; ++i) {
    const Vec3 &a = piece.corner[0], &b = piece.corner[i - 1], &c = piece.corner[i];
    const Vec3 normal = glm::cross(b - a, c - a);
    twice += normal;
    flux.moment += 0.5 * normal.x * ((a.x + b.x + c.x) / 3.0 - x);
  }
  flux.across += 0.5 * twice.x;
  flux.area += 0.5 * glm::length(twice);
}

/// One layer of the world, wide along x and deep along z.
class Layer {
 public:
  Layer(const World& world, const BitVolume& scene, int y)
      : world_(world),
        scene_(scene),
        y_(y),
        width_(scene.size().x),
        depth_(scene.size().z),
        found_(at(0, depth_)),
        touched_(at(0, depth_), false) {}

  /// Of all meshes together. A piece in the plane between two voxels belongs to the upper one, as in tiling.
  void add(const Layered& mesh) {
    const auto& numbers = mesh.layers[static_cast<std::size_t>(y_)];
    if (numbers.empty() || mesh.first_z > mesh.last_z) return;
    first_z_ = mesh.first_z;
    flux_.assign(
        static_cast<std::size_t>(mesh.last_z - mesh.first_z + 1) * static_cast<std::size_t>(width_ + 1), {});
    for (const std::uint32_t i : numbers) {
      const auto& t = mesh.tiled->mesh.triangles[i];
      CutPolygon triangle;
      for (const std::uint32_t corner : t) triangle.add(mesh.vertices_vx[corner]);
      const CutPolygon slice = cutToSlab(triangle, 1, y_, y_ + 1);
      if (slice.count < 3 || boundsAlong(slice, 1).first >= y_ + 1) continue;
      const auto [low, high] = boundsAlong(slice, 2);
      const int last = cellAlong(std::min(high, depth_ - 0.5));
      for (int z = cellAlong(std::max(low, 0.0)); z <= last; ++z) addRow(cutToSlab(slice, 2, z, z + 1), z);
    }
    for (int z = mesh.first_z; z <= mesh.last_z; ++z) settle(mesh, z);
  }

  /// Says which voxels are touched, and appends what was found there.
  void take(BitVolume& touched, std::vector<Occupancy>& values) const {
    for (int z = 0; z < depth_; ++z) {
      for (int x = 0; x < width_; ++x) {
        if (!touched_[at(x, z)]) continue;
        touched.set({x, y_, z});
        values.push_back(found_[at(x, z)]);
      }
    }
  }

 private:
  std::size_t at(int x, int z) const {
    return static_cast<std::size_t>(z) * static_cast<std::size_t>(width_) + static_cast<std::size_t>(x);
  }
  /// Of the mesh at hand. Behind each row lies a cell for all that is beyond the world.
  Flux& flux(int x, int z) {
    return flux_[static_cast<std::size_t>(z - first_z_) * static_cast<std::size_t>(width_ + 1) +
                 static_cast<std::size_t>(x)];
  }

  void addRow(const CutPolygon& row, int z) {
    if (row.count < 3 || boundsAlong(row, 2).first >= z + 1) return;
    const auto [low, high] = boundsAlong(row, 0);
    const int last = cellAlong(std::min(high, width_ - 0.5));
    for (int x = cellAlong(std::max(low, 0.0)); x <= last; ++x) {
      const CutPolygon piece = cutToSlab(row, 0, x, x + 1);
      if (piece.count >= 3 && boundsAlong(piece, 0).first < x + 1) sim::add(flux(x, z), piece, x);
    }
    if (high >= width_) {
      const CutPolygon beyond = cut(row, 0, width_, 1.0);
      if (beyond.count >= 3) sim::add(flux(width_, z), beyond, width_);
    }
  }

  /// A guess at what a run of touched voxels holds.
  struct Guess {
    double side = 1.0;   ///< -1: the surface is inside out here
    double right = 0.0;  ///< how much of the row is inside just beyond the run
    double left = 0.0;   ///< just before it
    double error = 0.0;  ///< how much of it cannot be
  };
  Guess guess(int first, int last, int z, double side, double right, std::optional<bool> left_inside) {
    Guess g{side, right, right, 0.0};
    for (int x = last; x >= first; --x) {
      const double volume = g.left + side * flux(x, z).moment;
      g.left += side * flux(x, z).across;
      // Overlapping bodies are more than full.
      g.error += std::max(0.0, -volume) + 0.25 * std::max(0.0, volume - 1.0);
    }
    if (left_inside) g.error += *left_inside ? std::max(0.0, 1.0 - g.left) : std::abs(g.left);
    return g;
  }

  /// Whether a voxel that this mesh does not touch lies inside it; nothing where other meshes have it, or
  /// where tiling, which rounds, found it touched.
  std::optional<bool> inside(const Layered& mesh, int x, int z) const {
    const Voxel v(x, y_, z);
    if (!scene_.at(v)) return false;
    if (!mesh.owns(world_.partAt(v))) return std::nullopt;
    const auto surface = world_.surfaceAt(v);
    if (surface->coverage < 1.0f || surface->normal != Vec3f(0.0f)) return std::nullopt;
    return true;
  }

  /// Finds how much of each voxel of a row the mesh takes, from its far end on.
  void settle(const Layered& mesh, int z) {
    double side = 1.0, right = std::abs(flux(width_, z).across);
    for (int x = width_ - 1; x >= 0;) {
      if (flux(x, z).area == 0.0) {
        const auto known = inside(mesh, x, z);
        if (known) right = *known ? 1.0 : 0.0;
        if (mesh.fills && right > 0.5 && scene_.at({x, y_, z})) found_[at(x, z)] = {1.0f, 1.0f};
        if (!known && mesh.owns(world_.partAt({x, y_, z}))) touched_[at(x, z)] = true;
        --x;
        continue;
      }
      const int last = x;
      while (x >= 0 && flux(x, z).area > 0.0) --x;
      const auto left = x < 0 ? std::nullopt : inside(mesh, x, z);
      Guess best = guess(x + 1, last, z, side, right, left);
      const Guess other = guess(x + 1, last, z, -side, right, left);
      if (other.error < best.error) best = other;
      // A hundredth for each voxel is rounding of the mesh; a sheet across the row leaves a whole.
      const bool fits = best.error <= 0.02 + 0.01 * (last - x);
      put(mesh, x + 1, last, z, best, mesh.fills && (fits || mesh.tiled->solid));
      side = best.side;
      right = std::clamp(best.left, 0.0, 1.0);
    }
  }

  void put(const Layered& mesh, int first, int last, int z, const Guess& g, bool body) {
    constexpr double kNothing = 1e-3;
    double beyond = g.right;
    for (int x = last; x >= first; --x) {
      const Flux& here = flux(x, z);
      const double volume = std::clamp(beyond + g.side * here.moment, 0.0, 1.0);
      beyond += g.side * here.across;
      if (!scene_.at({x, y_, z})) continue;
      Occupancy taken{static_cast<float>(volume), static_cast<float>(volume)};
      if (!body || (volume < kNothing && standsAlone(mesh, {x, y_, z})))
        taken = sheetOccupancy(here.area, mesh.thickness_vx);
      Occupancy& sum = found_[at(x, z)];
      sum = {std::min(1.0f, sum.alpha + taken.alpha), std::min(1.0f, sum.stops + taken.stops)};
      touched_[at(x, z)] = true;
    }
  }

  /// A sheet along the row encloses nothing, as little as the face of a body that only touches a voxel: but
  /// behind that one lies the body.
  bool standsAlone(const Layered& mesh, Voxel v) const {
    if (mesh.tiled->solid) return false;
    const auto surface = world_.surfaceAt(v);
    if (!surface || surface->normal == Vec3f(0.0f)) return true;
    const Voxel step = voxelAt(Vec3(surface->normal));
    const auto own = [&](Voxel at) { return scene_.at(at) && mesh.owns(world_.partAt(at)); };
    return !own(v + step) && !own(v - step);
  }

  const World& world_;
  const BitVolume& scene_;
  int y_, width_, depth_, first_z_ = 0;
  std::vector<Flux> flux_;
  std::vector<Occupancy> found_;
  std::vector<bool> touched_;
};

}  // namespace

Occupancy sheetOccupancy(double coverage, double thickness_vx) {
  return {static_cast<float>(std::clamp(coverage * thickness_vx, 0.0, 1.0)),
          static_cast<float>(std::clamp(coverage, 0.0, 1.0))};
}

Field<Occupancy> meshOccupancy(const World& world, const BitVolume& scene,
                               const std::vector<TiledMesh>& meshes, std::span<const double> thickness_vx) {
  if (thickness_vx.size() != meshes.size())
    throw InputError(fmt::format("{} meshes have {} thicknesses; expected one for each", meshes.size(),
                                 thickness_vx.size()));
  std::vector<Layered> all;
  PartId first_part = 1;
  for (std::size_t i = 0; i < meshes.size(); ++i) {
    const Mesh& mesh = meshes[i].mesh;
    if (!(thickness_vx[i] > 0.0) || !std::isfinite(thickness_vx[i]))
      throw InputError(fmt::format("mesh '{}': a thickness of {} voxel widths; expected more than 0",
                                   mesh.name, thickness_vx[i]));
    if (!meshes[i].guide && !mesh.triangles.empty())
      all.push_back(layered(world, meshes[i], first_part, thickness_vx[i]));
    first_part += static_cast<PartId>(mesh.regions.size());
  }
  const Voxel size = world.frame().size;
  BitVolume touched(size);
  std::vector<std::vector<Occupancy>> layers(static_cast<std::size_t>(size.y));
  parallelForEach(layers.size(), [&](std::size_t y) {
    throwIfStopped();
    Layer layer(world, scene, static_cast<int>(y));
    for (const Layered& mesh : all) layer.add(mesh);
    layer.take(touched, layers[y]);
  });
  Field<Occupancy> field{size, {}, std::make_shared<const VoxelSet>(std::move(touched))};
  field.values.reserve(field.where->count());
  for (std::vector<Occupancy>& layer : layers) {
    field.values.insert(field.values.end(), layer.begin(), layer.end());
    layer = {};
  }
  return field;
}

}  // namespace espalier::sim
