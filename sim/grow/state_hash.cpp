#include "sim/base/hasher.h"
#include "sim/grow/growth.h"

namespace espalier::sim {

namespace {

void add(Hasher& hash, const Columns& columns) {
  hash.add(columns.size());
  for (const auto& [name, column] : columns) {
    hash.add(std::string_view(name));
    hash.add(column.index());
    std::visit([&](const auto& values) { hash.add(values); }, column);
  }
}

/// Of the elements that stand there: a thin one may have no voxel to tell of it.
void addShapes(Hasher& hash, const Plant& plant) {
  std::vector<bool> stands(plant.shapes.size(), false);
  for (const PlacedElement& e : plant.elements) stands[static_cast<std::size_t>(e.shape)] = true;
  for (std::size_t i = 0; i < plant.shapes.size(); ++i) {
    if (!stands[i]) continue;
    for (const auto& polygon : plant.shapes[i].polygons) hash.add(polygon);
  }
}

}  // namespace

std::uint64_t stateHash(const World& world, const Growth& growth) {
  Hasher hash;
  hash.add(world.occupied().words());
  hash.add(world.opaque().words());
  hash.add(growth.plants.size());
  for (const Plant& plant : growth.plants) {
    const Skeleton& s = plant.skeleton;
    hash.add(s.parent);
    hash.add(s.position_vx);
    hash.add(s.born);
    for (const auto& [name, values] : s.columns) {
      hash.add(std::string_view(name));
      hash.add(values);
    }
    hash.add(plant.elements.size());
    for (const PlacedElement& e : plant.elements) {
      hash.add(e.node);
      hash.add(e.shape);
      for (const Vec3& v : {e.position_vx, e.x, e.y, e.z}) hash.add(v);
      hash.add(e.scale);
      hash.add(e.exposure);
      hash.add(e.born);
    }
    addShapes(hash, plant);
  }
  for (const Stand& stand : growth.stands) add(hash, stand.memory);
  for (const auto& [name, columns] : growth.commons) {
    hash.add(std::string_view(name));
    add(hash, columns);
  }
  return hash.digest();
}

}  // namespace espalier::sim
