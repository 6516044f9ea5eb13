#pragma once
#include <array>
#include <cstdint>

#include "sim/base/vec.h"

namespace espalier::sim {

/// What a random number is drawn for. Numbers follow from the key alone (Philox4x32-10, Salmon et al. 2011),
/// never from the order of drawing: pruning one branch does not reshuffle another, and parallel equals
/// serial.
struct RandomKey {
  std::uint64_t seed = 0;
  std::uint32_t plant = 0;
  std::uint32_t agent = 0;  ///< the bud within its plant
  std::uint32_t iteration = 0;
};

/// Keeps the draws for different ends apart.
enum class Purpose : std::uint32_t { rate, tip, branch, branch_age, element, scatter, opacity, sky, spot };

/// A stream of numbers for one key, purpose and trial.
class Draws {
 public:
  Draws(const RandomKey& key, Purpose purpose, std::uint32_t trial = 0);

  std::uint32_t bits() {
    if (used_ == 4) refill();
    return buffer_[used_++];
  }
  /// Evenly in [0, 1), in steps of 2^-32.
  double uniform() { return bits() * 0x1p-32; }
  double uniform(double low, double high) { return low + (high - low) * uniform(); }
  /// Evenly in [low, high], both included.
  int whole(int low, int high);
  /// Evenly on the unit sphere.
  Vec3 onSphere();
  /// Evenly within a cone about a unit axis; `cos_half_angle` 1 gives the axis, -1 the whole sphere.
  Vec3 inCone(Vec3 axis, double cos_half_angle);

 private:
  void refill();

  std::array<std::uint32_t, 4> counter_;
  std::array<std::uint32_t, 2> key_;
  std::array<std::uint32_t, 4> buffer_{};
  unsigned used_ = 4;
};

/// A unit vector perpendicular to a unit vector.
Vec3 perpendicular(Vec3 unit);

}  // namespace espalier::sim
