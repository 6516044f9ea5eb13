#pragma once
#include <cstdint>
#include <span>
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
  struct Slot {
    std::uint64_t key = 0;  // of a voxel; 0: free
    Node node;
  };

  bool mayBeTaken(std::uint64_t key) const;
  std::size_t slotOf(std::uint64_t key) const;
  const Node* takerOf(Voxel v) const;
  void grow();

  Voxel size_;
  std::vector<std::uint64_t> marks_;  // bits by a hash of the voxel: most are not taken
  std::vector<Slot> slots_;           // a key's is the first from its place on that is its own or free
  std::vector<std::uint64_t> keys_;   // of all that are taken
};

}  // namespace espalier::sim
