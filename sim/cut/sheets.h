#pragma once
// Internal to the wing: how far places are from sheets.
#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "sim/base/vec.h"

namespace espalier::sim {

/// A parallelogram; a line where one of its sides is zero, or both point one way. In voxel widths.
struct Sheet {
  Vec3 at{0.0}, along{0.0}, across{0.0};
};

/// The distance from a place to the nearest place of a sheet.
double distanceTo(const Sheet& sheet, Vec3 p);

/// Cubes of voxels, as leaves of OpenVDB are.
inline constexpr int kBlock = 8;

/// Where a place is looked for instead of where it is: smooth noise with octaves.
class Straying {
 public:
  /// Lengths in voxel widths. `amplitude`: in the mean of squares; waves from `longest` down to `shortest`.
  Straying(double amplitude, double longest, double shortest, std::uint64_t stream);
  Vec3 operator()(Vec3 p) const;
  /// How far it may stray along any axis.
  double farthest() const;

 private:
  static constexpr int kSide = 32;
  std::vector<float> table_;  // three numbers, -1 .. 1, at each corner
  struct Octave {
    double per_voxel, amplitude;
  };
  std::vector<Octave> octaves_;
};

/// A block, and which of the sheets come near to it.
struct NearSheets {
  Voxel origin{0};  ///< its least voxel
  std::vector<std::uint32_t> sheets;
};

/// The blocks between two voxels that places nearer than `reach` to a sheet lie in, in (x, y, z) order.
std::vector<NearSheets> blocksNear(std::span<const Sheet> sheets, double reach, Voxel low, Voxel high);

/// The voxels of a block, x by x, then y, then z: where each is looked for, and how far that is from sheets.
struct StrayedBlock {
  static constexpr std::size_t kVoxels = kBlock * kBlock * kBlock;
  std::array<Vec3, kVoxels> place;
  std::array<double, kVoxels> distance;

  /// Without a function each is where it is.
  void stray(Voxel origin, const std::function<Vec3(Vec3)>& straying);
  /// The nearest of some sheets; what is farther than `most` is `most` away.
  void measure(std::span<const std::uint32_t> some, std::span<const Sheet> sheets, double most);
};

}  // namespace espalier::sim
