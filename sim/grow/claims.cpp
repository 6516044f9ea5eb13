#include "sim/grow/claims.h"

#include <algorithm>

#include "sim/base/error.h"
#include "sim/sense/intersection.h"

namespace espalier::sim {
namespace {

/// Never 0.
std::uint64_t keyOf(Voxel v) {
  return (std::uint64_t{1} << 63) | (static_cast<std::uint64_t>(v.y) << 42) |
         (static_cast<std::uint64_t>(v.z) << 21) | static_cast<std::uint64_t>(v.x);
}

std::uint64_t spread(std::uint64_t key) {
  return key * 0x9e3779b97f4a7c15u;
}

constexpr int kMarkBits = 20;  // 128 kB of marks
constexpr std::size_t kFewestSlots = 1024;

std::size_t markOf(std::uint64_t key) {
  return spread(key) >> (64 - kMarkBits);
}

}  // namespace

Claims::Claims(Voxel size) : size_(size), marks_((std::size_t{1} << kMarkBits) / 64), slots_(kFewestSlots) {}

bool Claims::mayBeTaken(std::uint64_t key) const {
  const std::size_t mark = markOf(key);
  return (marks_[mark / 64] >> (mark % 64) & 1) != 0;
}

std::size_t Claims::slotOf(std::uint64_t key) const {
  const std::size_t mask = slots_.size() - 1;  // a power of two
  std::size_t slot = (spread(key) >> 32) & mask;
  while (slots_[slot].key != 0 && slots_[slot].key != key) slot = (slot + 1) & mask;
  return slot;
}

/// Null where nobody took it.
const Claims::Node* Claims::takerOf(Voxel v) const {
  const std::uint64_t key = keyOf(v);
  if (!mayBeTaken(key)) return nullptr;
  const Slot& slot = slots_[slotOf(key)];
  return slot.key == 0 ? nullptr : &slot.node;
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

/// Twice the slots: more than half of them would be taken.
void Claims::grow() {
  std::vector<Slot> before(2 * slots_.size());
  before.swap(slots_);
  for (const Slot& slot : before) {
    if (slot.key != 0) slots_[slotOf(slot.key)] = slot;
  }
}

void Claims::take(std::span<const Voxel> voxels, Node node) {
  for (const Voxel v : voxels) {
    if (!contains(size_, v)) throw BrokenContract("a process proposed a voxel outside the world");
    const std::uint64_t key = keyOf(v);
    const std::size_t mark = markOf(key);
    marks_[mark / 64] |= std::uint64_t{1} << (mark % 64);
    Slot* slot = &slots_[slotOf(key)];
    if (slot->key != 0) continue;  // who came first keeps it
    if (2 * keys_.size() >= slots_.size()) {
      grow();
      slot = &slots_[slotOf(key)];
    }
    *slot = {key, node};
    keys_.push_back(key);
  }
}

void Claims::keepFree(std::vector<Voxel>& voxels) const {
  std::erase_if(voxels, [&](Voxel v) { return takerOf(v) != nullptr; });
}

void Claims::clear() {
  for (const std::uint64_t key : keys_) marks_[markOf(key) / 64] = 0;
  const bool roomy = 8 * keys_.size() < slots_.size();
  slots_.assign(roomy ? std::max(kFewestSlots, slots_.size() / 2) : slots_.size(), Slot{});
  keys_.clear();
}

}  // namespace espalier::sim
