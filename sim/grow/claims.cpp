#include "sim/grow/claims.h"

#include <algorithm>

#include "sim/base/error.h"
#include "sim/sense/intersection.h"

namespace espalier::sim {
namespace {

std::uint64_t packed(Voxel v) {
  return (static_cast<std::uint64_t>(v.y) << 42) | (static_cast<std::uint64_t>(v.z) << 21) |
         static_cast<std::uint64_t>(v.x);
}

Voxel unpacked(std::uint64_t k) {
  constexpr std::uint64_t kMask = (1u << 21) - 1;
  return {static_cast<int>(k & kMask), static_cast<int>(k >> 42), static_cast<int>((k >> 21) & kMask)};
}

}  // namespace

bool Claims::allow(std::span<const Voxel> voxels, Node node, Voxel start) const {
  return std::none_of(voxels.begin(), voxels.end(), [&](Voxel v) {
    return taken_.at(v) && !(besides(v, start) && owner_.at(packed(v)) == node);
  });
}

bool Claims::allow(std::span<const Voxel> voxels, std::size_t plant) const {
  return std::none_of(voxels.begin(), voxels.end(),
                      [&](Voxel v) { return taken_.at(v) && owner_.at(packed(v)).first != plant; });
}

void Claims::take(std::span<const Voxel> voxels, Node node) {
  for (const Voxel v : voxels) {
    if (!contains(taken_.size(), v)) throw BrokenContract("a process proposed a voxel outside the world");
    taken_.set(v);
    owner_.emplace(packed(v), node);
  }
}

void Claims::keepFree(std::vector<Voxel>& voxels) const {
  std::erase_if(voxels, [&](Voxel v) { return taken_.at(v); });
}

void Claims::clear() {
  for (const auto& [voxel, node] : owner_) taken_.clear(unpacked(voxel));
  owner_.clear();
}

}  // namespace espalier::sim
