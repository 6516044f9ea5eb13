#pragma once
#include <array>
#include <cstdint>
#include <string_view>

#include "sim/base/vec.h"

/// Random numbers by key: each follows from what it is for and from nothing else (Philox4x32-10, Salmon et
/// al. 2011), never from the order of drawing. So pruning one branch does not reshuffle another, a rule that
/// asks for one quantity more moves no other, and parallel equals serial.
namespace espalier::sim {

/// Who draws. Numbers and iterations are told apart below 2^24.
struct RandomKey {
  std::uint64_t stream = 0;     ///< streamOf the run and the plant
  std::uint32_t node = 0;       ///< the plant's node, or the number of the place
  std::uint32_t number = 0;     ///< which of the node's sites
  std::uint32_t iteration = 0;  ///< of growth
};

/// A stream of its own for each run (its seed), planting (its name) and plant (XXH3; two streams fall
/// together with a chance of 2^-64).
std::uint64_t streamOf(std::uint64_t seed, std::string_view planting = {}, std::uint64_t plant = 0);

/// The draws that belong to a voxel. Its coordinates must lie in 0 .. 65,535.
RandomKey keyAt(std::uint64_t stream, Voxel v);

/// What a number is drawn for: keeps the draws for different ends apart. Those from `custom` on are left to
/// processes that are not of this house.
enum class Purpose : std::uint8_t {
  rate = 0,
  trial = 1,
  branch_age = 2,
  element_count = 3,
  element = 4,
  scatter = 5,
  opacity = 6,
  sky = 7,
  spot = 8,
  attractor = 9,
  rough = 10,
  relief = 11,
  custom = 128
};

/// Philox's input: what tells a trial's numbers from all others.
struct PhiloxInput {
  std::array<std::uint32_t, 4> counter;  ///< the last word holds the trial from bit 8 on, and the block below
  std::array<std::uint32_t, 2> key;
};

/// Throws BrokenContract for a number, an iteration, an item or a trial beyond what can be told apart.
PhiloxInput philoxInput(const RandomKey& key, Purpose purpose, unsigned item = 0, unsigned trial = 0);

/// The numbers of one key, purpose, item and trial, by slot: slot k holds the same number whichever others
/// are asked for, and four that lie side by side (4k .. 4k + 3) cost as much as one. A quantity that has a
/// slot of its own suits many trials at once, lane by lane.
class Slots {
 public:
  static constexpr unsigned kSlots = 1024;   ///< of one trial
  static constexpr unsigned kItems = 65536;  ///< of a purpose: rule sets, elements
  static constexpr unsigned kTrials = 65536;
  static constexpr unsigned kNumbers = 1u << 24;  ///< sites of a node, and iterations

  /// See philoxInput.
  Slots(const RandomKey& key, Purpose purpose, unsigned item = 0, unsigned trial = 0)
      : input_(philoxInput(key, purpose, item, trial)) {}

  /// Throws BrokenContract for a slot from kSlots on: it would be another trial's.
  std::uint32_t bits(unsigned slot) {
    if (slot / 4 != block_) fill(slot / 4);
    return buffer_[slot % 4];
  }
  /// Evenly in [0, 1), in steps of 2^-32.
  double uniform(unsigned slot) { return bits(slot) * 0x1p-32; }
  /// The same in single precision, in steps of 2^-24.
  float uniformFloat(unsigned slot) { return static_cast<float>(bits(slot) >> 8) * 0x1p-24f; }

 private:
  void fill(unsigned block);

  PhiloxInput input_;
  std::array<std::uint32_t, 4> buffer_{};
  unsigned block_ = kSlots;  // none
};

/// The slots in their order, for what draws an unknown number of times, and at most Slots::kSlots.
class Draws {
 public:
  Draws(const RandomKey& key, Purpose purpose, unsigned item = 0, unsigned trial = 0)
      : slots_(key, purpose, item, trial) {}

  std::uint32_t bits() { return slots_.bits(next_++); }
  double uniform() { return slots_.uniform(next_++); }
  double uniform(double low, double high) { return low + (high - low) * uniform(); }
  /// Evenly in [low, high], both included.
  int whole(int low, int high);
  /// Evenly on the unit sphere. Takes two numbers.
  Vec3 onSphere();
  /// See sim::inCone. Takes two numbers.
  Vec3 inCone(Vec3 axis, double cos_half_angle);

 private:
  Slots slots_;
  unsigned next_ = 0;
};

/// Evenly within a cone about a unit axis, from two even numbers in [0, 1): how far round, and how high.
/// `cos_half_angle` 1 gives the axis, -1 the whole sphere.
Vec3 inCone(Vec3 axis, double cos_half_angle, double turn, double height);

/// Cosine and sine of a number of full turns, by polynomials: within 2e-16, and the same bits on every
/// processor.
glm::dvec2 unitCircle(double turns);

/// A unit vector perpendicular to a unit vector.
Vec3 perpendicular(Vec3 unit);

}  // namespace espalier::sim
