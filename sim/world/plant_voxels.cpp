#include "sim/world/plant_voxels.h"

#include <cassert>

namespace espalier::sim {

PlantVoxels::Entry& PlantVoxels::entryAt(Voxel v) {
  Block& block = blocks_.make(v);
  return block.entries[numberIn(block, v)];
}

void PlantVoxels::note(Block& block, int plant) {
  block.plant = block.plant == kNobody || block.plant == plant ? plant : kSeveral;
}

std::uint32_t PlantVoxels::lookOf(const Surface& surface) {
  const auto part = static_cast<std::size_t>(surface.part);
  if (part >= latest_.size()) latest_.resize(part + 1);
  const Look look{surface.colour, surface.normal, surface.offset_vx};
  std::uint32_t& latest = latest_[part];  // the voxels of a leaf come one after the other
  if (latest == 0 || looks_[latest - 1] != look) {
    looks_.push_back(look);
    latest = static_cast<std::uint32_t>(looks_.size());
  }
  return latest - 1;
}

Surface PlantVoxels::surfaceOf(const Entry& entry) const {
  const Look& look = looks_[entry.look];
  return {entry.part, look.colour, entry.coverage, look.normal, look.offset_vx};
}

std::optional<Surface> PlantVoxels::surfaceAt(Voxel v) const {
  const Entry* const entry = find(v);
  if (entry == nullptr) return std::nullopt;
  return surfaceOf(*entry);
}

void PlantVoxels::add(Voxel v, const Surface& surface, int plant) {
  assert(find(v) == nullptr);
  Block& block = blocks_.make(v);
  note(block, plant);
  auto& entries = block.entries;
  if (entries.size() == entries.capacity()) entries.reserve(entries.size() + entries.size() / 4 + 4);
  entries.insert(entries.begin() + static_cast<std::ptrdiff_t>(numberIn(block, v)),
                 {surface.part, lookOf(surface), surface.coverage});
  taken_.set(v);
  const std::size_t row = rowOf(v);
  for (std::size_t r = 0; r < block.first.size(); ++r)  // of all of them: in lanes
    block.first[r] = static_cast<std::uint16_t>(block.first[r] + (r > row ? 1 : 0));
}

float PlantVoxels::addCoverage(Voxel v, float coverage) {
  return entryAt(v).coverage += coverage;
}

void PlantVoxels::takeOver(Voxel v, const Surface& surface, int plant) {
  note(blocks_.make(v), plant);
  Entry& entry = entryAt(v);
  entry.part = surface.part;
  entry.look = lookOf(surface);
}

}  // namespace espalier::sim
