#include <xxhash.h>

#include "sim/grow/growth.h"

namespace espalier::sim {
namespace {

/// Feeds values to XXH3; padding bytes never reach it.
class Hasher {
 public:
  Hasher() : state_(XXH3_createState()) { XXH3_64bits_reset(state_); }
  Hasher(const Hasher&) = delete;
  Hasher& operator=(const Hasher&) = delete;
  ~Hasher() { XXH3_freeState(state_); }

  template <typename T>
  void add(const std::vector<T>& values) {
    add(values.size());
    XXH3_64bits_update(state_, values.data(), values.size() * sizeof(T));
  }
  void add(std::string_view text) {
    add(text.size());
    XXH3_64bits_update(state_, text.data(), text.size());
  }
  void add(const Columns& columns) {
    add(columns.size());
    for (const auto& [name, column] : columns) {
      add(std::string_view(name));
      add(column.index());
      std::visit([&](const auto& values) { add(values); }, column);
    }
  }
  template <typename T>
  requires std::is_arithmetic_v<T> || std::is_same_v<T, Vec3>
  void add(const T& value) { XXH3_64bits_update(state_, &value, sizeof value); }
  std::uint64_t digest() const { return XXH3_64bits_digest(state_); }

 private:
  XXH3_state_t* state_;
};

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
  }
  for (const Stand& stand : growth.stands) hash.add(stand.memory);
  for (const auto& [name, columns] : growth.commons) {
    hash.add(std::string_view(name));
    hash.add(columns);
  }
  return hash.digest();
}

}  // namespace espalier::sim
