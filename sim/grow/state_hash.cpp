#include <xxhash.h>

#include "sim/grow/grow.h"

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
  template <typename T>
  requires std::is_arithmetic_v<T> || std::is_same_v<T, Vec3>
  void add(const T& value) { XXH3_64bits_update(state_, &value, sizeof value); }
  std::uint64_t digest() const { return XXH3_64bits_digest(state_); }

 private:
  XXH3_state_t* state_;
};

}  // namespace

std::uint64_t stateHash(const World& world, const std::vector<Plant>& plants) {
  Hasher hash;
  hash.add(world.occupied().words());
  hash.add(plants.size());
  for (const Plant& plant : plants) {
    const Skeleton& s = plant.skeleton;
    hash.add(s.parent);
    hash.add(s.position_vx);
    hash.add(s.born);
    hash.add(s.exposure);
    hash.add(s.sky_exposure);
    hash.add(s.sun_exposure);
    hash.add(s.proximity_vx);
    hash.add(plant.elements.size());
    for (const PlacedElement& e : plant.elements) {
      hash.add(e.node);
      hash.add(e.shape);
      for (const Vec3& v : {e.position_vx, e.x, e.y, e.z}) hash.add(v);
      hash.add(e.scale);
    }
  }
  return hash.digest();
}

}  // namespace espalier::sim
