#include "sim/scatter/inside_points.h"

#include <fmt/format.h>
#include <openvdb/tools/MeshToVolume.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "sim/base/bits.h"
#include "sim/base/error.h"
#include "sim/base/parallel.h"
#include "sim/base/random.h"
#include "sim/tile/fill.h"

namespace espalier::sim {
namespace {

constexpr float kBand_vx = 3.0f;  // a point looks at distances up to two diagonals from the surface
constexpr int kRim = 3;           // free voxels around the mesh

struct Grid {
  Frame frame;
  Triangles triangles_vx;
  Filled filled;  // by voxels' centres, those on the surface too
};

/// The frame that gives a mesh's longest side so many voxels.
Frame frameOf(const Mesh& mesh, int voxels) {
  Vec3 low(INFINITY), high(-INFINITY);
  for (const auto& triangle : mesh.triangles) {
    for (const std::uint32_t v : triangle) {
      low = glm::min(low, mesh.vertices_m[v]);
      high = glm::max(high, mesh.vertices_m[v]);
    }
  }
  const Vec3 extent = high - low;
  const double longest = std::max({extent.x, extent.y, extent.z});
  if (!(longest > 0.0) || !std::isfinite(longest)) {
    throw InputError(fmt::format("mesh '{}': has no inside; expected triangles with an area", mesh.name));
  }
  const double voxel = longest / voxels;
  return {low - kRim * voxel, voxel, Voxel(glm::ceil(extent / voxel)) + 2 * kRim + 1};
}

Grid gridOf(const Mesh& mesh, int voxels) {
  Grid grid{frameOf(mesh, voxels), {}, {}};
  for (const auto& t : mesh.triangles) {
    grid.triangles_vx.push_back({voxelFromWorld(grid.frame, mesh.vertices_m[t[0]]),
                                 voxelFromWorld(grid.frame, mesh.vertices_m[t[1]]),
                                 voxelFromWorld(grid.frame, mesh.vertices_m[t[2]])});
  }
  grid.filled = fillMesh(grid.triangles_vx, BitVolume(grid.frame.size), true);
  return grid;
}

/// As fine as a slender mesh needs to have voxels in it.
Grid fineGridOf(const Mesh& mesh) {
  constexpr std::size_t kEnough = 4096;
  constexpr int kCoarse = 128, kMiddling = 256, kFine = 512;
  Grid grid = gridOf(mesh, kCoarse);
  if (grid.filled.inside.count() < kEnough) grid = gridOf(mesh, kMiddling);
  const std::size_t inside = grid.filled.inside.count();
  if (inside > 0 && inside < kEnough) grid = gridOf(mesh, kFine);
  return grid;
}

/// The signed distance from a mesh near its surface, in voxels.
class Distance {
 public:
  explicit Distance(const Grid& grid) : inside_(grid.filled.inside) {
    std::vector<openvdb::Vec3s> corners;
    std::vector<openvdb::Vec3I> triangles;
    for (const auto& triangle : grid.triangles_vx) {
      const auto first = static_cast<std::uint32_t>(corners.size());
      triangles.emplace_back(first, first + 1, first + 2);
      for (const Vec3& p : triangle) corners.emplace_back(p.x, p.y, p.z);
    }
    // Of types that OpenVDB's library holds compiled: its templates take a minute for any others.
    const openvdb::tools::QuadAndTriangleDataAdapter<openvdb::Vec3s, openvdb::Vec3I> mesh(corners, triangles);
    const auto unit = openvdb::math::Transform::createLinearTransform(1.0);
    openvdb::util::NullInterrupter never;
    // On one thread: which of two equally near triangles comes first would depend on their number.
    onThreads(1, [&] {
      distance_ = openvdb::tools::meshToVolume<openvdb::FloatGrid>(
          never, mesh, *unit, kBand_vx, kBand_vx, openvdb::tools::UNSIGNED_DISTANCE_FIELD, nullptr);
    });
  }

  /// Reads for one thread.
  class Reader {
   public:
    explicit Reader(const Distance& distance)
        : inside_(distance.inside_), values_(distance.distance_->getConstAccessor()) {}

    /// Linear between the centres of voxels.
    double at(Vec3 p_vx) {
      const Vec3 low = glm::floor(p_vx), part = p_vx - low;
      double sum = 0.0;
      for (int corner = 0; corner < 8; ++corner) {
        const Voxel step(corner & 1, corner >> 1 & 1, corner >> 2);
        const Vec3 weight = glm::mix(1.0 - part, part, Vec3(step));
        sum += weight.x * weight.y * weight.z * signedAt(Voxel(low) + step);
      }
      return sum;
    }

   private:
    double signedAt(Voxel v) {
      const double distance = values_.getValue(openvdb::Coord(v.x, v.y, v.z));
      return inside_.at(v) ? -distance : distance;
    }

    const BitVolume& inside_;
    openvdb::FloatGrid::ConstAccessor values_;
  };

 private:
  const BitVolume& inside_;
  openvdb::FloatGrid::Ptr distance_;
};

/// The voxels that hold a point inside, in (y, z, x) order: what is inside, and what lies beside it.
std::vector<Voxel> candidatesOf(const BitVolume& inside) {
  const Voxel size = inside.size();
  const auto near = [&](Voxel v) {
    for (int y = -1; y <= 1; ++y) {
      for (int z = -1; z <= 1; ++z) {
        for (int x = -1; x <= 1; ++x) {
          if (inside.at(v + Voxel(x, y, z))) return true;
        }
      }
    }
    return false;
  };
  std::vector<std::vector<Voxel>> layers(static_cast<std::size_t>(size.y));
  parallelForEach(layers.size(), [&](std::size_t y) {
    for (int z = 0; z < size.z; ++z) {
      for (int x = 0; x < size.x; ++x) {
        const Voxel v(x, static_cast<int>(y), z);
        if (near(v)) layers[y].push_back(v);
      }
    }
  });
  std::vector<Voxel> all;
  for (const auto& layer : layers) all.insert(all.end(), layer.begin(), layer.end());
  return all;
}

/// A point inside, the first of a key's throws that is.
Vec3 throwInside(const std::vector<Voxel>& candidates, Distance::Reader& distance, const RandomKey& key,
                 const Mesh& mesh) {
  for (unsigned trial = 0; trial < Slots::kTrials; ++trial) {
    Slots slots(key, Purpose::attractor, 0, trial);
    const std::uint64_t pick = slots.bits(0) * std::uint64_t{candidates.size()} >> 32;
    const Vec3 p = Vec3(candidates[pick]) + Vec3(slots.uniform(1), slots.uniform(2), slots.uniform(3)) - 0.5;
    if (distance.at(p) < 0.0) return p;
  }
  throw InputError(
      fmt::format("mesh '{}': too thin to strew points in; expected one with an inside", mesh.name));
}

/// Throws for a mesh that has no inside, or hardly one; `instead`: what else would do.
InsideDoubt soundInside(const Mesh& mesh, const Filled& filled, const char* instead) {
  const std::size_t sure = filled.inside.count();
  if (sure == 0) {
    throw InputError(
        fmt::format("mesh '{}': is a sheet, which has no inside; expected a mesh that holds something{}",
                    mesh.name, instead));
  }
  const auto may_be = static_cast<double>(sure + filled.outvoted);
  const InsideDoubt doubt{static_cast<double>(filled.doubtful) / may_be,
                          static_cast<double>(filled.undecided) / may_be};
  if (doubt.undecided > kMostUndecided) {
    throw InputError(fmt::format(
        "mesh '{}': is so open that its inside is a guess for {:.0f} % of it; expected at most {:.0f} %{}",
        mesh.name, 100.0 * doubt.undecided, 100.0 * kMostUndecided, instead));
  }
  return doubt;
}

}  // namespace

InsidePoints scatterWithin(const Mesh& mesh, std::size_t count, std::uint64_t stream) {
  if (count == 0 || count > std::numeric_limits<std::uint32_t>::max())
    throw InputError(fmt::format("{} points in a mesh; expected 1 to 2^32 - 1", count));
  const Grid grid = fineGridOf(mesh);
  InsidePoints result{{}, soundInside(mesh, grid.filled, ", or points on its surface")};
  const std::vector<Voxel> candidates = candidatesOf(grid.filled.inside);
  const Distance distance(grid);
  result.points.at.resize(count);
  result.points.normal.resize(count, Vec3(0.0));
  parallelFor(count, [&](std::size_t begin, std::size_t end) {
    Distance::Reader reader(distance);
    for (std::size_t k = begin; k < end; ++k) {
      result.points.at[k] = worldFromVoxel(
          grid.frame, throwInside(candidates, reader, {stream, static_cast<std::uint32_t>(k)}, mesh));
    }
  });
  return result;
}

InsideCells cellsWithin(const Mesh& mesh) {
  Grid grid = fineGridOf(mesh);
  const InsideDoubt doubt = soundInside(mesh, grid.filled, "");
  return {grid.frame, std::move(grid.filled.inside), doubt};
}

}  // namespace espalier::sim
