// Triangles are tiled in parallel, in fixed chunks. Each gives a share for every voxel that it meets: the
// area of it inside the cube. The shares are sorted by (voxel, triangle), which no two of one whole triangle
// have in common, so that every sum below runs in the same order on any number of threads.
#include "sim/tile/tile_mesh.h"

#include <oneapi/tbb/parallel_sort.h>

#include <algorithm>
#include <cmath>
#include <tuple>

#include "sim/base/parallel.h"
#include "sim/base/stop.h"
#include "sim/tile/clip.h"
#include "sim/tile/triangle_rows.h"

namespace espalier::sim {
namespace {

struct Share {
  std::uint64_t voxel;  ///< index in (y, z, x) order
  std::uint32_t triangle;
  float area;  ///< inside the cube; a face has area 1

  friend bool operator<(const Share& a, const Share& b) {
    return std::tie(a.voxel, a.triangle, a.area) < std::tie(b.voxel, b.triangle, b.area);
  }
};

/// The areas of a triangle's pieces in the cubes of voxels.
class Pieces {
 public:
  explicit Pieces(const std::array<Fixed, 3>& q) {
    for (const Fixed& p : q) triangle_.add(Vec3(p) / static_cast<double>(kFixedOne));
    const Vec3 n(normalOf(q));
    const Vec3 size = glm::abs(n);
    // Areas are had from the projection along the normal's largest component.
    u_ = size.x >= size.y && size.x >= size.z ? 1 : size.y >= size.z ? 2 : 0;
    w_ = (u_ + 1) % 3;
    scale_ = glm::length(n) / size[(u_ + 2) % 3] / 2.0;
  }

  void enterRow(int y, int z) {
    if (y != y_) slice_ = cutToSlab(triangle_, 1, y, y + 1);
    y_ = y;
    row_ = cutToSlab(slice_, 2, z, z + 1);
  }

  double area(int x) const {
    const CutPolygon piece = cutToSlab(row_, 0, x, x + 1);
    if (piece.count < 3) return 0.0;
    double twice = 0.0;
    const Vec3 hub = piece.corner[0];
    for (std::size_t i = 2; i < piece.count; ++i) {
      const Vec3 a = piece.corner[i - 1] - hub;
      const Vec3 b = piece.corner[i] - hub;
      twice += a[u_] * b[w_] - a[w_] * b[u_];
    }
    return std::abs(twice) * scale_;
  }

 private:
  CutPolygon triangle_, slice_, row_;
  int u_ = 0, w_ = 1;
  double scale_ = 0.0;
  int y_ = std::numeric_limits<int>::min();
};

class Tiler {
 public:
  explicit Tiler(Voxel size) : size_(size) {}

  void add(const std::array<Vec3, 3>& t, std::uint32_t triangle, std::vector<Share>& shares) {
    const Vec3 low = glm::min(glm::min(t[0], t[1]), t[2]);
    const Vec3 high = glm::max(glm::max(t[0], t[1]), t[2]);
    for (int axis = 0; axis < 3; ++axis) {
      if (high[axis] < -1.0 || low[axis] > size_[axis]) return;
    }
    for (int axis = 0; axis < 3; ++axis) {
      if (low[axis] < -kReach || high[axis] > kReach) return addVast(t, triangle, shares);
    }
    addWithinReach(t, triangle, shares);
  }

 private:
  static constexpr double kReach = 16000.0;  ///< inside what Fixed can hold

  /// A triangle too large for fixed point is cut to the world first.
  void addVast(const std::array<Vec3, 3>& t, std::uint32_t triangle, std::vector<Share>& shares) {
    const CutPolygon polygon = cutToBox(t, Vec3(-2.0), Vec3(size_) + 1.0);
    for (std::size_t i = 2; i < polygon.count; ++i) {
      addWithinReach({polygon.corner[0], polygon.corner[i - 1], polygon.corner[i]}, triangle, shares);
    }
  }

  void addWithinReach(const std::array<Vec3, 3>& t, std::uint32_t triangle, std::vector<Share>& shares) {
    const std::array<Fixed, 3> q{fromCorner(fixedFromVoxel(t[0])), fromCorner(fixedFromVoxel(t[1])),
                                 fromCorner(fixedFromVoxel(t[2]))};
    if (normalOf(q) == glm::i64vec3(0)) {
      flat_.clear();
      tileTriangle(t, flat_);
      for (const Voxel v : flat_) {
        if (contains(size_, v)) shares.push_back({index(v.x, v.y, v.z), triangle, 0.0f});
      }
      return;
    }
    Pieces pieces(q);
    forEachTriangleRow(q, Voxel(0), size_ - 1, [&](int y, int z, int first, int last) {
      throwIfStopped();
      pieces.enterRow(y, z);
      for (int x = first; x <= last; ++x) {
        shares.push_back({index(x, y, z), triangle, static_cast<float>(pieces.area(x))});
      }
    });
  }

  std::uint64_t index(int x, int y, int z) const {
    return (static_cast<std::uint64_t>(y) * static_cast<std::uint64_t>(size_.z) +
            static_cast<std::uint64_t>(z)) *
               static_cast<std::uint64_t>(size_.x) +
           static_cast<std::uint64_t>(x);
  }

  Voxel size_;
  std::vector<Voxel> flat_;
};

std::vector<Share> sharesOf(const Mesh& mesh, const std::vector<Vec3>& vertices_vx, Voxel size) {
  constexpr std::size_t kChunk = 512;
  std::vector<std::vector<Share>> chunks((mesh.triangles.size() + kChunk - 1) / kChunk);
  parallelForEach(chunks.size(), [&](std::size_t c) {
    Tiler tiler(size);
    const std::size_t last = std::min((c + 1) * kChunk, mesh.triangles.size());
    for (std::size_t i = c * kChunk; i < last; ++i) {
      const auto& t = mesh.triangles[i];
      tiler.add({vertices_vx[t[0]], vertices_vx[t[1]], vertices_vx[t[2]]}, static_cast<std::uint32_t>(i),
                chunks[c]);
    }
  });
  std::vector<std::size_t> start(chunks.size() + 1, 0);
  for (std::size_t c = 0; c < chunks.size(); ++c) start[c + 1] = start[c] + chunks[c].size();
  std::vector<Share> shares(start.back());
  parallelForEach(chunks.size(), [&](std::size_t c) {
    std::copy(chunks[c].begin(), chunks[c].end(), shares.begin() + static_cast<std::ptrdiff_t>(start[c]));
    chunks[c] = {};
  });
  tbb::parallel_sort(shares.begin(), shares.end());
  return shares;
}

/// The region with the greatest sum of weights; of equal ones the first.
std::uint32_t largestRegion(std::vector<std::pair<std::uint32_t, double>>& weights) {
  const auto before = [](const auto& a, const auto& b) { return a.first < b.first; };
  if (!std::is_sorted(weights.begin(), weights.end(), before))
    std::stable_sort(weights.begin(), weights.end(), before);  // sums run in the order of the triangles
  std::pair<std::uint32_t, double> largest{weights.front().first, -1.0};
  for (auto next = weights.begin(); next != weights.end();) {
    std::pair<std::uint32_t, double> sum{next->first, 0.0};
    for (; next != weights.end() && next->first == sum.first; ++next) sum.second += next->second;
    if (sum.second > largest.second) largest = sum;
  }
  return largest.first;
}

/// What the triangles that share a voxel make of it together.
Surface joined(const Mesh& mesh, const std::vector<Vec3>& vertices_vx, Voxel voxel,
               std::span<const Share> shares, PartId first_part) {
  double total = 0.0;
  for (const Share& s : shares) total += s.area;
  glm::dvec3 colour(0.0);
  Vec3 normal(0.0);
  double offset = 0.0;  // of the planes, along their own normals
  double weights = 0.0;
  std::vector<std::pair<std::uint32_t, double>> of_regions;  // and their weights
  for (const Share& s : shares) {
    const double weight = total > 0.0 ? s.area : 1.0;  // all only touch: they count alike
    weights += weight;
    colour += weight * glm::dvec3(mesh.materials[mesh.material[s.triangle]].colour);
    const auto& t = mesh.triangles[s.triangle];
    const Vec3 across =
        glm::cross(vertices_vx[t[1]] - vertices_vx[t[0]], vertices_vx[t[2]] - vertices_vx[t[0]]);
    const double length = glm::length(across);
    if (length > 0.0) {
      normal += (weight / length) * across;
      offset += (weight / length) * glm::dot(across, vertices_vx[t[0]] - Vec3(voxel));
    }
    of_regions.emplace_back(mesh.region[s.triangle], weight);
  }
  const double length = glm::length(normal);
  Surface surface{.part = first_part + static_cast<PartId>(largestRegion(of_regions)),
                  .colour = Colour(colour / weights),
                  .coverage = static_cast<float>(std::min(total, 1.0))};
  constexpr double kCancelled = 1e-6;  // of the weights: two sides of a thin wall leave no direction
  if (length > kCancelled * weights) {
    // Where faces meet at an edge, the plane with the mean normal through that edge.
    constexpr double kHalfDiagonal = 0.8660254;
    surface.normal = Vec3f(normal / length);
    surface.offset_vx = static_cast<float>(std::clamp(offset / length, -kHalfDiagonal, kHalfDiagonal));
  }
  return surface;
}

}  // namespace

std::vector<TiledVoxel> tileMesh(const Mesh& mesh, const std::vector<Vec3>& vertices_vx, Voxel size,
                                 PartId first_part) {
  const std::vector<Share> shares = sharesOf(mesh, vertices_vx, size);
  std::vector<std::size_t> groups;
  for (std::size_t i = 0; i < shares.size(); ++i) {
    if (i == 0 || shares[i].voxel != shares[i - 1].voxel) groups.push_back(i);
  }
  std::vector<TiledVoxel> voxels(groups.size());
  groups.push_back(shares.size());
  parallelForEach(voxels.size(), [&](std::size_t g) {
    const std::span<const Share> mine(shares.data() + groups[g], groups[g + 1] - groups[g]);
    const std::uint64_t row = mine[0].voxel / static_cast<std::uint64_t>(size.x);
    const Voxel v(static_cast<int>(mine[0].voxel % static_cast<std::uint64_t>(size.x)),
                  static_cast<int>(row / static_cast<std::uint64_t>(size.z)),
                  static_cast<int>(row % static_cast<std::uint64_t>(size.z)));
    voxels[g] = {v, joined(mesh, vertices_vx, v, mine, first_part)};
  });
  return voxels;
}

}  // namespace espalier::sim
