#include "sim/cut/level_set.h"

#include <openvdb/math/Proximity.h>
#include <openvdb/openvdb.h>
#include <openvdb/tools/Composite.h>
#include <openvdb/tools/MeshToVolume.h>
#include <openvdb/tools/SignedFloodFill.h>
#include <openvdb/tools/VolumeToMesh.h>

#include <algorithm>
#include <cmath>

#include "sim/base/parallel.h"
#include "sim/base/stop.h"

namespace espalier::sim {
namespace {

using openvdb::Coord;
using Grid = openvdb::FloatGrid;
using Leaf = Grid::TreeType::LeafNodeType;

constexpr float kBand = static_cast<float>(LevelSet::kBand_vx);
/// What gives way to keep surfaces apart lies just outside.
constexpr float kBarely = 0.02f;

/// Asks whether the job is stopped, on whatever thread.
class Interrupter final : public openvdb::util::NullInterrupter {
 public:
  bool wasInterrupted(int) override {
    const HandedStops::Scope scope(stops_);
    return stopRequested();
  }

 private:
  HandedStops stops_;
};

Grid::Ptr emptyGrid() {
  const auto grid = Grid::create(kBand);
  grid->setTransform(openvdb::math::Transform::createLinearTransform(1.0));
  grid->setGridClass(openvdb::GRID_LEVEL_SET);
  return grid;
}

/// A leaf's voxels at their distances, and nothing where they are farther than the band.
void setLeaf(Leaf& leaf, const std::function<float(const Coord&)>& distance) {
  for (openvdb::Index i = 0; i < Leaf::SIZE; ++i) {
    const float d = distance(leaf.offsetToGlobalCoord(i));
    const float kept = std::clamp(d, -kBand, kBand);
    if (std::abs(d) < kBand) {
      leaf.setValueOn(i, kept);
    } else {
      leaf.setValueOff(i, kept);
    }
  }
}

/// OpenVDB's distances without signs are too large by up to a third of a voxel: which triangle is nearest is
/// taken over from neighbours. Near the surface one looks at all that they have.
constexpr float kNearBy = 1.8f;

/// The triangles that are nearest to a voxel and to those around it, each once.
std::vector<std::int32_t> around(openvdb::Int32Grid::ConstAccessor& nearest, const Coord& at) {
  std::vector<std::int32_t> some;
  for (int x = -1; x <= 1; ++x) {
    for (int y = -1; y <= 1; ++y) {
      for (int z = -1; z <= 1; ++z) {
        const std::int32_t triangle = nearest.getValue(at.offsetBy(x, y, z));
        if (triangle >= 0 && std::find(some.begin(), some.end(), triangle) == some.end())
          some.push_back(triangle);
      }
    }
  }
  return some;
}

float nearestOf(const std::vector<std::int32_t>& some, const std::vector<openvdb::Vec3s>& points,
                const std::vector<openvdb::Vec3I>& faces, const Coord& at) {
  const openvdb::Vec3d p = at.asVec3d();
  double least = kBand * kBand;
  for (const std::int32_t triangle : some) {
    const openvdb::Vec3I& face = faces[static_cast<std::size_t>(triangle)];
    openvdb::Vec3d weights;
    const openvdb::Vec3d on = openvdb::math::closestPointOnTriangleToPoint(
        openvdb::Vec3d(points[face[0]]), openvdb::Vec3d(points[face[1]]), openvdb::Vec3d(points[face[2]]), p,
        weights);
    least = std::min(least, (on - p).lengthSqr());
  }
  return static_cast<float>(std::sqrt(least));
}

/// Whether one of the two of a voxel and another that lies askew touch by an edge or a corner alone, and it
/// is this one that gives way: the nearer to the outside, or else the first.
bool givesWay(Grid::ConstAccessor& values, const Coord& v, float value) {
  const auto inside = [&](int x, int y, int z) { return values.getValue(v.offsetBy(x, y, z)) < 0.0f; };
  const auto weaker = [&](int x, int y, int z) {
    const float other = values.getValue(v.offsetBy(x, y, z));
    return value > other || (value == other && Coord(0, 0, 0) < Coord(x, y, z));
  };
  std::array<bool, 6> face{};  // -x, +x, -y ..
  bool all = true;
  for (int k = 0; k < 6; ++k) {
    const int step = k % 2 == 0 ? -1 : 1;
    face[static_cast<std::size_t>(k)] =
        inside(k / 2 == 0 ? step : 0, k / 2 == 1 ? step : 0, k / 2 == 2 ? step : 0);
    all = all && face[static_cast<std::size_t>(k)];
  }
  if (all) return false;
  const auto in = [&](int axis, int step) { return face[static_cast<std::size_t>(2 * axis + (step > 0))]; };
  for (const int a : {-1, 1}) {
    for (const int b : {-1, 1}) {
      if (!in(0, a) && !in(1, b) && inside(a, b, 0) && weaker(a, b, 0)) return true;
      if (!in(0, a) && !in(2, b) && inside(a, 0, b) && weaker(a, 0, b)) return true;
      if (!in(1, a) && !in(2, b) && inside(0, a, b) && weaker(0, a, b)) return true;
      for (const int c : {-1, 1}) {
        const bool xy = inside(a, b, 0), xz = inside(a, 0, c), yz = inside(0, b, c), far = inside(a, b, c);
        // Two corners that lie across are all that is inside; or all that is not, this one beside the first.
        if (!in(0, a) && !in(1, b) && !in(2, c) && !xy && !xz && !yz && far && weaker(a, b, c)) return true;
        if (!in(0, a) && in(1, b) && in(2, c) && xy && xz && !yz && far) return true;
      }
    }
  }
  return false;
}

}  // namespace

struct LevelSet::Grids {
  Grid::Ptr matter;
  Grid::Ptr before;                 // it was cut
  openvdb::Int32Grid::Ptr nearest;  // triangle
};

LevelSet::LevelSet(std::span<const Vec3> corners, std::span<const std::array<std::uint32_t, 3>> triangles,
                   const BitVolume& inside)
    : grids_(std::make_unique<Grids>()) {
  openvdb::initialize();
  std::vector<openvdb::Vec3s> points;
  points.reserve(corners.size());
  for (const Vec3& p : corners) points.emplace_back(p.x, p.y, p.z);
  std::vector<openvdb::Vec3I> faces;
  faces.reserve(triangles.size());
  for (const auto& [a, b, c] : triangles) faces.emplace_back(a, b, c);
  // Of types that OpenVDB's library holds compiled: its templates take a minute for any others.
  const openvdb::tools::QuadAndTriangleDataAdapter<openvdb::Vec3s, openvdb::Vec3I> mesh(points, faces);
  grids_->nearest = openvdb::Int32Grid::create(-1);
  Interrupter interrupter;
  Grid::Ptr distances;
  // On one thread: which of two equally near triangles comes first would depend on their number. Without
  // signs, as OpenVDB fills cavities and clears what is inside of overlapping bodies; the vote knows better.
  onThreads(1, [&] {
    distances = openvdb::tools::meshToVolume<Grid>(
        interrupter.interrupter(), mesh, *openvdb::math::Transform::createLinearTransform(1.0), kBand, kBand,
        openvdb::tools::UNSIGNED_DISTANCE_FIELD, grids_->nearest.get());
  });
  throwIfStopped();
  grids_->matter = emptyGrid();
  for (auto leaf = distances->tree().cbeginLeaf(); leaf; ++leaf)
    grids_->matter->tree().touchLeaf(leaf->origin());
  std::vector<Leaf*> leaves;
  grids_->matter->tree().getNodes(leaves);
  parallelFor(leaves.size(), [&](std::size_t begin, std::size_t end) {
    auto values = distances->getConstAccessor();
    auto nearest = grids_->nearest->getConstAccessor();
    for (std::size_t i = begin; i < end; ++i) {
      setLeaf(*leaves[i], [&](const Coord& at) {
        float d = kBand;
        if (!values.probeValue(at, d)) d = kBand;
        if (d < kNearBy) d = nearestOf(around(nearest, at), points, faces, at);
        return inside.at({at.x(), at.y(), at.z()}) ? -d : d;
      });
    }
  });
  openvdb::tools::signedFloodFill(grids_->matter->tree());
  grids_->before = grids_->matter->deepCopy();
}

LevelSet::~LevelSet() = default;

float LevelSet::distanceAt(Vec3 p) const {
  const Vec3 low = glm::floor(p), part = p - low;
  auto values = grids_->before->getConstAccessor();
  double sum = 0.0;
  for (int k = 0; k < 8; ++k) {
    const Voxel step(k & 1, k >> 1 & 1, k >> 2);
    const Vec3 weight = glm::mix(1.0 - part, part, Vec3(step));
    const Voxel v = Voxel(low) + step;
    sum += weight.x * weight.y * weight.z * static_cast<double>(values.getValue({v.x, v.y, v.z}));
  }
  return static_cast<float>(sum);
}

std::int32_t LevelSet::nearestAt(Vec3 p) const {
  const Voxel v = Voxel(glm::floor(p + 0.5));
  return grids_->nearest->tree().getValue({v.x, v.y, v.z});
}

void LevelSet::cut(std::span<const NearSheets> near, std::span<const Sheet> sheets, double half_kerf,
                   const std::function<Vec3(Vec3)>& straying) {
  const Grid::Ptr gap = emptyGrid();
  std::vector<Leaf*> leaves;
  std::vector<std::size_t> blocks;
  const auto matter = grids_->matter->getConstAccessor();
  for (std::size_t i = 0; i < near.size(); ++i) {
    const Coord origin(near[i].origin.x, near[i].origin.y, near[i].origin.z);
    if (matter.probeConstLeaf(origin) == nullptr && matter.getValue(origin) > 0.0f) continue;  // in the open
    leaves.push_back(gap->tree().touchLeaf(origin));
    blocks.push_back(i);
  }
  parallelFor(leaves.size(), [&](std::size_t begin, std::size_t end) {
    StrayedBlock block;
    for (std::size_t i = begin; i < end; ++i) {
      block.stray(near[blocks[i]].origin, straying);
      block.measure(near[blocks[i]].sheets, sheets, half_kerf + kBand_vx);
      setLeaf(*leaves[i], [&](const Coord& at) {
        return static_cast<float>(block.distance[static_cast<std::size_t>(Leaf::coordToOffset(at))] -
                                  half_kerf);
      });
    }
  });
  // Blocks that lie in the gap as a whole are among them, so all beside them is outside of it. Nothing is
  // pruned: where places stray far, signs may change between two voxels out of the band.
  openvdb::tools::csgDifference(*grids_->matter, *gap, false);
  throwIfStopped();
}

void LevelSet::activateCrossings() {
  std::vector<Leaf*> leaves;
  grids_->matter->tree().getNodes(leaves);
  std::vector<std::vector<Coord>> found(leaves.size());
  parallelFor(leaves.size(), [&](std::size_t begin, std::size_t end) {
    auto values = grids_->matter->getConstAccessor();
    constexpr int kLast = static_cast<int>(Leaf::DIM) - 1;
    for (std::size_t i = begin; i < end; ++i) {
      for (auto at = leaves[i]->cbeginValueAll(); at; ++at) {
        const Coord v = at.getCoord(), local = v - leaves[i]->origin();
        const bool rim = local.x() == 0 || local.x() == kLast || local.y() == 0 || local.y() == kLast ||
                         local.z() == 0 || local.z() == kLast;
        if (at.isValueOn() && !rim) continue;
        for (int k = 0; k < 6; ++k) {
          Coord next = v;
          next[k / 2] += k % 2 == 0 ? -1 : 1;
          float value = 0.0f;
          const bool on = values.probeValue(next, value);
          if ((value < 0.0f) == (*at < 0.0f) || (on && at.isValueOn())) continue;
          found[i].push_back(v);
          found[i].push_back(next);
        }
      }
    }
  });
  auto voxels = grids_->matter->getAccessor();
  for (const std::vector<Coord>& of_leaf : found)
    for (const Coord& v : of_leaf) voxels.setActiveState(v, true);
}

void LevelSet::separate() {
  for (bool more = true; more;) {
    std::vector<Leaf*> leaves;
    grids_->matter->tree().getNodes(leaves);
    std::vector<std::vector<openvdb::Index>> giving(leaves.size());
    parallelFor(leaves.size(), [&](std::size_t begin, std::size_t end) {
      auto values = grids_->matter->getConstAccessor();
      for (std::size_t i = begin; i < end; ++i) {
        for (auto at = leaves[i]->cbeginValueOn(); at; ++at) {
          if (*at < 0.0f && givesWay(values, at.getCoord(), *at)) giving[i].push_back(at.pos());
        }
      }
    });
    more = false;
    for (std::size_t i = 0; i < leaves.size(); ++i) {
      for (const openvdb::Index at : giving[i]) leaves[i]->setValueOn(at, kBarely);
      more = more || !giving[i].empty();
    }
  }
}

QuadSurface LevelSet::surface() {
  activateCrossings();
  separate();
  activateCrossings();  // what gave way has new ones
  std::vector<openvdb::Vec3s> points;
  std::vector<openvdb::Vec4I> quads;
  openvdb::tools::volumeToMesh(*grids_->matter, points, quads, 0.0);
  throwIfStopped();
  QuadSurface surface;
  surface.points.reserve(points.size());
  for (const openvdb::Vec3s& p : points) surface.points.emplace_back(p.x(), p.y(), p.z());
  surface.quads.reserve(quads.size());
  for (const openvdb::Vec4I& q : quads) surface.quads.push_back({q[3], q[2], q[1], q[0]});
  return surface;
}

}  // namespace espalier::sim
