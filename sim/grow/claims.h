#pragma once
#include <cstdint>
#include <span>
#include <unordered_map>
#include <utility>
#include <vector>

#include "sim/grow/plant.h"

namespace espalier::sim {

/// Voxels that segments took earlier in the same iteration, and from which node.
class Claims {
 public:
  /// A node of any plant.
  using Node = std::pair<std::size_t, NodeId>;

  explicit Claims(Voxel size);

  /// Whether a segment that leaves `node` at `start` may have these voxels. A branch and its limb leave their
  /// node through the same voxels: beside it they do not hinder each other.
  bool allow(std::span<const Voxel> voxels, Node node, Voxel start) const;
  /// Whether no other plant has claimed one of these.
  bool allow(std::span<const Voxel> voxels, std::size_t plant) const;
  /// Throws BrokenContract for a voxel outside the world.
  void take(std::span<const Voxel> voxels, Node node);
  /// Leaves the voxels that nobody has claimed.
  void keepFree(std::vector<Voxel>& voxels) const;
  void clear();

 private:
  bool mayBeTaken(std::uint64_t packed) const;
  const Node* takerOf(Voxel v) const;

  Voxel size_;
  std::vector<std::uint64_t> marks_;               // bits by a hash of the voxel: most are not taken
  std::unordered_map<std::uint64_t, Node> owner_;  // by packed voxel
};

}  // namespace espalier::sim
