#pragma once
// Internal to the wing: loops that are compiled for each instruction set and chosen when the program runs.
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "sim/base/bits.h"
#include "sim/light/clear_bricks.h"
#include "sim/light/filled_ahead.h"
#include "sim/sweep/directions.h"

namespace espalier::sim::looking {

inline constexpr int kNear = 6;  ///< voxels to each side that are looked at for all directions at once
/// A row of them is read by four voxels.
inline constexpr std::size_t kFours = (2 * kNear + 4) / 4;
/// Beyond what is near, a ray's steps are tested leg by leg: how many there are up to the end of each.
inline constexpr std::array<std::size_t, 4> kLegs{0, 16, 32, 56};
inline constexpr std::size_t kSteps = kLegs.back();
inline constexpr std::size_t kAtOnce = 8;                          ///< steps that are read together
inline constexpr int kFar = kNear + 1 + static_cast<int>(kSteps);  ///< no step lies farther away
static_assert(kNear < ClearBricks::kSide);
static_assert(kFar < BitVolume::kWordBits);  // beyond the ends of a row lies a word of zeros

/// A bit for each direction of a group.
struct alignas(32) Mask {
  std::array<std::uint64_t, ClearBricks::kWords> words{};
};

/// One direction beyond what is near.
struct Ray {
  std::array<std::int64_t, kSteps> steps;  ///< from the place, in bits of the volume
  std::array<Voxel, kLegs.size()> beyond;  ///< the voxel behind what is near, and behind each leg
  /// How many steps lie within so many voxels of the place along y, and along z.
  std::array<std::uint8_t, kFar> within_y, within_z;
  std::size_t near;  ///< steps before these
};

/// In coarse worlds a ray's voxels beyond what is near are met leg by leg; none leads farther along any axis,
/// so that a leg lies in two bricks along each.
inline constexpr int kLeg = FilledAhead::kSide - 1;

/// Legs of all directions one after another: of each as many as a multiple of what is read at once, those
/// that fill up farther along than any world is long.
struct Legs {
  std::vector<std::int16_t> x, y, z;  ///< from the place to a leg's first voxel
  std::vector<std::int16_t> along;    ///< that of depth, without its sign
  std::vector<std::int32_t> period;   ///< the period of the direction that the first voxel lies in
  std::vector<std::uint16_t> step;    ///< and its number in there
  std::vector<std::uint8_t> voxels;
  /// From the first voxel of a period to its others and as many of the next as a leg may have, in bits of the
  /// volume. As many as are read at once lie behind the last.
  std::vector<std::int64_t> steps;
  struct Ray {
    std::array<std::int32_t, 3> spans{};  ///< the longest that a leg is along each axis: at most kLeg
    std::size_t first, count;             ///< one more follows, which begins outside of the world
    std::size_t first_step;
    std::int64_t period;  ///< in bits of the volume
  };
  std::vector<Ray> rays;
};

/// How rays are walked beyond what is near in worlds that are not coarse.
struct Walks {
  /// By axis and by the place's way into its brick: the directions that leave what is near in the brick
  /// before, in the same, and in the one behind.
  std::array<std::array<std::array<Mask, 3>, ClearBricks::kSide>, 3> leaving;
  std::vector<Ray> rays;
  /// From a place to the voxels of a period, in bits of the volume; those of direction i from first_step[i]
  /// on. As many steps as are read at once lie behind the last.
  std::vector<std::int64_t> period_steps;
  std::vector<std::size_t> first_step;
  /// A period's voxels in runs, none of which leads farther than a brick's side along any axis: of direction
  /// i the first voxel of each from first_run[i] on, and then how many voxels there are.
  std::vector<std::uint32_t> runs;
  std::vector<std::size_t> first_run;
};

/// As many directions as a mask has bits, made ready.
struct Group {
  std::span<const LatticeDirection> directions;
  std::size_t first;  ///< the first one's number among those of all groups
  int lowest;         ///< of the directions' near voxels, along y from the place: 0 or -kNear
  /// For each row of near voxels, from (lowest, -kNear) to (kNear, kNear) along (y, z), and each pattern of
  /// four of its voxels the directions that cross one of the pattern's.
  std::vector<std::array<std::array<Mask, 16>, kFours>> crossing;
  Walks walks;  ///< empty if the world is coarse
  Legs legs;    ///< empty if it is not
};

/// For each place a row of bits, `stride` words apart: the group's directions that reach the world's edge.
void look(const BitVolume& occupied, const Group& group, const ClearBricks& clear,
          std::span<const Voxel> places, std::uint64_t* open, std::size_t stride);

/// The same in worlds that are coarse. `ahead`: of the directions of all groups.
void look(const BitVolume& occupied, const Group& group, const FilledAhead& ahead,
          std::span<const Voxel> places, std::uint64_t* open, std::size_t stride);

/// Bits in lines of bytes, all of which are to be read at a step from where they are wanted.
struct Step {
  int lines;
  std::ptrdiff_t bytes;  ///< in all, those of the lines too
  int down;              ///< bits by which words are shifted: up if negative, and then in every step
  std::uint64_t mask;    ///< of a word's bits after the shift
};
inline constexpr std::size_t kMostBytesAtOnce = 64;

/// Each of `lines` lines of `bytes` bytes of target becomes the union of what the steps read from it. A step
/// that leads to no line of the source reads nothing; the farther ones come last. Other reads lie up to
/// `bytes` + kMostBytesAtOnce before or behind their line. Up to kMostBytesAtOnce behind a line are
/// overwritten, before the next line is.
void uniteSteps(std::uint8_t* target, std::size_t target_apart, const std::uint8_t* source,
                std::size_t source_apart, int lines, std::size_t bytes, std::span<const Step> steps);

/// Rows of floats are as long as a multiple of this.
inline constexpr std::size_t kRowUnit = 128;

/// The sum of the chosen rows, in the order in which they are chosen. Rows lie `apart` floats from each
/// other, and each has so many.
void sumRows(const float* rows, std::size_t apart, std::span<const std::uint32_t> chosen, float* sums);

}  // namespace espalier::sim::looking
