#include "sim/grow/earlier.h"

#include <algorithm>
#include <limits>
#include <utility>

#include "sim/base/stop.h"
#include "sim/tile/tiling.h"

namespace espalier::sim {
namespace {

constexpr std::int32_t kUnknown = std::numeric_limits<std::int32_t>::max();

/// By a plant's pieces: a voxel that several lie in has the first one's.
class Noting {
 public:
  Noting(const VoxelSet& where, std::vector<std::int32_t>& born) : where_(where), born_(born) {}

  void note(const Plant& plant) {
    const Skeleton& s = plant.skeleton;
    for (std::size_t n = 0; n < s.parent.size(); ++n) {
      const NodeId parent = s.parent[n];
      const Vec3 from = s.position_vx[parent == kNoNode ? n : static_cast<std::size_t>(parent)];
      tileSegment(from, s.position_vx[n], tiled_);
      take(s.born[n]);
    }
    for (const PlacedElement& element : plant.elements) {
      throwIfStopped();
      for (const auto& polygon : plant.shapes[static_cast<std::size_t>(element.shape)].polygons) {
        for (std::size_t k = 2; k < polygon.size(); ++k)
          tileTriangle(
              {placed(element, polygon[0]), placed(element, polygon[k - 1]), placed(element, polygon[k])},
              tiled_);
      }
      take(element.born);
    }
  }

 private:
  void take(std::int32_t born) {
    for (const Voxel v : tiled_) {
      if (!where_.has(v)) continue;
      std::int32_t& first = born_[where_.number(v)];
      first = std::min(first, born);
    }
    tiled_.clear();
  }

  const VoxelSet& where_;
  std::vector<std::int32_t>& born_;
  std::vector<Voxel> tiled_;
};

/// Of the voxels around one those that are known: the youngest; kUnknown where none is.
std::int32_t youngestBeside(const VoxelSet& where, const std::vector<std::int32_t>& born, Voxel v) {
  std::int32_t youngest = -1;
  for (int y = -1; y <= 1; ++y)
    for (int z = -1; z <= 1; ++z)
      for (int x = -1; x <= 1; ++x) {
        const Voxel beside = v + Voxel(x, y, z);
        if (!where.has(beside)) continue;
        const std::int32_t its = born[where.number(beside)];
        if (its != kUnknown) youngest = std::max(youngest, its);
      }
  return youngest < 0 ? kUnknown : youngest;
}

}  // namespace

Plant plantAfter(const Plant& plant, int iterations) {
  Plant earlier = plant;
  const Skeleton& all = plant.skeleton;
  Skeleton& some = earlier.skeleton;
  std::vector<NodeId> number(all.parent.size(), kNoNode);
  std::size_t kept = 0;
  for (std::size_t n = 0; n < all.parent.size(); ++n) {
    const NodeId parent = all.parent[n];
    const bool seed = parent == kNoNode;
    // In skeletons of others a limb may be born before what carries it.
    if (!seed && (all.born[n] >= iterations || number[static_cast<std::size_t>(parent)] == kNoNode)) continue;
    some.parent[kept] = seed ? kNoNode : number[static_cast<std::size_t>(parent)];
    some.position_vx[kept] = all.position_vx[n];
    some.born[kept] = all.born[n];
    for (auto& [name, values] : some.columns) values[kept] = values[n];
    number[n] = static_cast<NodeId>(kept++);
  }
  some.parent.resize(kept);
  some.position_vx.resize(kept);
  some.born.resize(kept);
  for (auto& [name, values] : some.columns) values.resize(kept);
  std::erase_if(earlier.elements, [&](const PlacedElement& element) {
    return element.born >= iterations ||
           (element.node >= 0 && number[static_cast<std::size_t>(element.node)] == kNoNode);
  });
  for (PlacedElement& element : earlier.elements) {
    if (element.node >= 0) element.node = number[static_cast<std::size_t>(element.node)];
  }
  return earlier;
}

VoxelBirths::VoxelBirths(const World& world, std::span<const Plant> plants, int iterations)
    : where_(world.inPlants()), born_(where_.count(), kUnknown) {
  Noting noting(where_, born_);
  for (const Plant& plant : plants) noting.note(plant);
  const std::vector<Voxel> voxels = where_.voxels();
  for (bool more = true; more;) {
    std::vector<std::pair<std::size_t, std::int32_t>> found;
    for (std::size_t i = 0; i < voxels.size(); ++i) {
      if (born_[i] != kUnknown) continue;
      const std::int32_t beside = youngestBeside(where_, born_, voxels[i]);
      if (beside != kUnknown) found.emplace_back(i, beside);
    }
    for (const auto& [i, born] : found) born_[i] = born;
    more = !found.empty();
  }
  taken_.assign(static_cast<std::size_t>(iterations) + 1, 0);
  for (std::int32_t& born : born_) {
    born = std::clamp(born, 0, std::max(0, iterations - 1));
    if (iterations > 0) ++taken_[static_cast<std::size_t>(born) + 1];
  }
  for (std::size_t k = 1; k < taken_.size(); ++k) taken_[k] += taken_[k - 1];
}

BitVolume VoxelBirths::after(const BitVolume& bits, int iterations) const {
  BitVolume earlier = bits;
  const Voxel size = bits.size();
  for (int y = 0; y < size.y; ++y) {
    for (int z = 0; z < size.z; ++z) {
      std::size_t number = where_.firstOfRow(y, z);
      const std::uint64_t* const taken = where_.bits().row(y, z);
      for (int word = 0; word * BitVolume::kWordBits < size.x; ++word) {
        for (std::uint64_t left = taken[word]; left != 0; left &= left - 1, ++number) {
          if (born_[number] >= iterations) earlier.row(y, z)[word] &= ~(left & (~left + 1));
        }
      }
    }
  }
  return earlier;
}

std::size_t VoxelBirths::takenAfter(int iterations) const {
  return taken_[static_cast<std::size_t>(std::clamp(iterations, 0, static_cast<int>(taken_.size()) - 1))];
}

}  // namespace espalier::sim
