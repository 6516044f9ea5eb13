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

constexpr int kMarkBits = 20;  // 128 kB of marks

std::size_t markOf(std::uint64_t packed) {
  return (packed * 0x9e3779b97f4a7c15u) >> (64 - kMarkBits);
}

}  // namespace

Claims::Claims(Voxel size) : size_(size), marks_((std::size_t{1} << kMarkBits) / 64) {}

bool Claims::mayBeTaken(std::uint64_t packed) const {
  const std::size_t mark = markOf(packed);
  return (marks_[mark / 64] >> (mark % 64) & 1) != 0;
}

/// Null where nobody took it.
const Claims::Node* Claims::takerOf(Voxel v) const {
  const std::uint64_t key = packed(v);
  if (!mayBeTaken(key)) return nullptr;
  const auto at = owner_.find(key);
  return at == owner_.end() ? nullptr : &at->second;
}

bool Claims::allow(std::span<const Voxel> voxels, Node node, Voxel start) const {
  return std::none_of(voxels.begin(), voxels.end(), [&](Voxel v) {
    const Node* const taker = takerOf(v);
    return taker != nullptr && !(besides(v, start) && *taker == node);
  });
}

bool Claims::allow(std::span<const Voxel> voxels, std::size_t plant) const {
  return std::none_of(voxels.begin(), voxels.end(), [&](Voxel v) {
    const Node* const taker = takerOf(v);
    return taker != nullptr && taker->first != plant;
  });
}

void Claims::take(std::span<const Voxel> voxels, Node node) {
  for (const Voxel v : voxels) {
    if (!contains(size_, v)) throw BrokenContract("a process proposed a voxel outside the world");
    const std::uint64_t key = packed(v);
    const std::size_t mark = markOf(key);
    marks_[mark / 64] |= std::uint64_t{1} << (mark % 64);
    owner_.emplace(key, node);
  }
}

void Claims::keepFree(std::vector<Voxel>& voxels) const {
  std::erase_if(voxels, [&](Voxel v) { return takerOf(v) != nullptr; });
}

void Claims::clear() {
  for (const auto& [key, node] : owner_) marks_[markOf(key) / 64] = 0;
  owner_.clear();
}

}  // namespace espalier::sim
