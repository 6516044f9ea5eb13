#include "sim/sense/peaks.h"

#include <algorithm>
#include <map>
#include <tuple>
#include <unordered_map>

#include "sim/base/stop.h"
#include "sim/world/world_grids.h"

namespace espalier::sim {
namespace {

/// Of one part, from the top down; on one height in rows.
bool higher(Voxel a, Voxel b) {
  return std::tie(b.y, a.z, a.x) < std::tie(a.y, b.z, b.x);
}

/// Voxels that are given one by one, from the top down, gathered in pieces that touch: where two meet, the
/// lower one's top is a peak if it rises high enough above the place.
class Rises {
 public:
  Rises(Voxel size, int prominence_vx) : size_(size), prominence_vx_(prominence_vx) {}

  void add(Voxel v) {
    const std::size_t own = pieces_.size();
    pieces_.push_back({own, v.y, v.y, Vec3(v), 1.0});
    known_.emplace(key(v), own);
    for (int dy = 0; dy <= 1; ++dy) {
      for (int dz = -1; dz <= 1; ++dz) {
        for (int dx = -1; dx <= 1; ++dx) {
          const Voxel beside = v + Voxel(dx, dy, dz);
          if (beside == v || !contains(size_, beside)) continue;
          if (const auto at = known_.find(key(beside)); at != known_.end())
            join(top(own), top(at->second), v.y);
        }
      }
    }
  }

  /// All peaks, now that there are no more voxels.
  std::vector<Vec3> peaks() {
    for (std::size_t i = 0; i < pieces_.size(); ++i) {
      if (pieces_[i].above == i && pieces_[i].top > pieces_[i].bottom) peaks_.push_back(middleOf(pieces_[i]));
    }
    std::stable_sort(peaks_.begin(), peaks_.end(), [](Vec3 a, Vec3 b) { return a.y > b.y; });
    return std::move(peaks_);
  }

 private:
  struct Piece {
    std::size_t above;  // the piece that it is a part of by now; its own number: none
    int top, bottom;
    Vec3 sum;  // of the places at its top
    double count;
  };

  std::uint64_t key(Voxel v) const {
    return (static_cast<std::uint64_t>(v.y) * static_cast<std::uint64_t>(size_.z) +
            static_cast<std::uint64_t>(v.z)) *
               static_cast<std::uint64_t>(size_.x) +
           static_cast<std::uint64_t>(v.x);
  }
  std::size_t top(std::size_t i) {
    while (pieces_[i].above != i) i = pieces_[i].above = pieces_[pieces_[i].above].above;
    return i;
  }
  static Vec3 middleOf(const Piece& piece) { return piece.sum / piece.count; }

  void join(std::size_t a, std::size_t b, int at_y) {
    if (a == b) return;
    if (std::tuple(pieces_[a].top, b) < std::tuple(pieces_[b].top, a)) std::swap(a, b);
    Piece &keeps = pieces_[a], &ends = pieces_[b];
    if (keeps.top == ends.top && (keeps.top - at_y < prominence_vx_)) {
      keeps.sum += ends.sum;
      keeps.count += ends.count;
    } else if (ends.top - at_y >= prominence_vx_) {
      peaks_.push_back(middleOf(ends));
    }
    keeps.bottom = std::min(keeps.bottom, ends.bottom);
    ends.above = a;
  }

  Voxel size_;
  int prominence_vx_;
  std::vector<Piece> pieces_;
  std::unordered_map<std::uint64_t, std::size_t> known_;
  std::vector<Vec3> peaks_;
};

void gather(const openvdb::Int32Grid& grid, std::map<PartId, std::vector<Voxel>>& of_parts) {
  for (auto leaf = grid.tree().cbeginLeaf(); leaf; ++leaf) {  // what lies in whole blocks is no top
    for (auto at = leaf->cbeginValueOn(); at; ++at) {
      const auto part = of_parts.find(*at);
      if (part != of_parts.end())
        part->second.emplace_back(at.getCoord().x(), at.getCoord().y(), at.getCoord().z());
    }
  }
}

}  // namespace

std::vector<Peak> peaksOf(const World& world, std::span<const PartId> parts, int prominence_vx) {
  std::map<PartId, std::vector<Voxel>> of_parts;
  for (const PartId part : parts) of_parts[part];
  gather(*world.grids().part, of_parts);
  gather(*world.grids().guide, of_parts);
  std::vector<Peak> peaks;
  for (auto& [part, voxels] : of_parts) {
    throwIfStopped();
    std::sort(voxels.begin(), voxels.end(), higher);
    Rises rises(world.frame().size, prominence_vx);
    for (const Voxel v : voxels) rises.add(v);
    for (const Vec3 at : rises.peaks()) peaks.push_back({part, at});
  }
  return peaks;
}

}  // namespace espalier::sim
