#pragma once
#include <array>
#include <cstdint>
#include <vector>

#include "sim/base/bits.h"
#include "sim/base/faces.h"
#include "sim/base/voxel_set.h"
#include "sim/sweep/directions.h"
#include "sim/world/field.h"

/// The sibling of sim/sweep/sweep.h that carries a value in place of a bit: what lies where a ray ends. Along
/// a direction v, with o_1 .. o_m = v the voxels crossed in one period,
///     seen(p) = the value of the first stop among p + o_1 .. p + o_m, or else seen(p + v).
/// Exactly what casting each ray from the centre of each voxel gives that is no stop, at a cost in proportion
/// to the voxels.
namespace espalier::sim {

/// Voxels at which rays end, with a value for each of their faces (sim/base/faces.h) that has no other of
/// them before it: a ray sees that of the face through which it comes.
template <typename Value>
struct Stops {
  struct OfFace {
    VoxelSet where{BitVolume()};  ///< the stops that have such a face
    std::vector<std::int32_t> x;  ///< of each of them
    std::vector<Value> values;
    /// The z of the rows that have any, slice by slice; of slice y from first_row[y] on.
    std::vector<std::int32_t> rows;
    std::vector<std::size_t> first_row;
  };
  /// Values of 0.
  explicit Stops(BitVolume of);

  BitVolume where;
  std::array<OfFace, kFaces> faces;
};

/// The faces through which a ray comes into the voxels that it crosses in one period.
std::vector<std::uint8_t> facesEntered(const LatticeDirection& direction);

/// Slices of what voxels see along one direction, the last few of them; of stops themselves nothing is said.
/// Value: 16 or 32 bits.
template <typename Value>
class CarriedSweep {
 public:
  /// `open`: what is seen where a ray reaches the world's edge. Borrows both.
  CarriedSweep(const Stops<Value>& stops, const LatticeDirection& direction, Value open);

  /// Slices come in order: downwards from the top where the direction goes up or is level, else upwards.
  bool downwards() const { return v_.y >= 0; }
  void run(int y);
  /// A row of the slice that was run last; null where nothing but `open` is seen.
  const Value* row(int z) const { return filled_[rowIndex(last_, z)] != 0 ? at(last_, z) : nullptr; }

 private:
  std::size_t rowIndex(int y, int z) const {
    return static_cast<std::size_t>(y % slots_) * static_cast<std::size_t>(size_.z) +
           static_cast<std::size_t>(z);
  }
  const Value* at(int y, int z) const {
    return seen_.data() + rowIndex(y, z) * static_cast<std::size_t>(size_.x);
  }
  Value* at(int y, int z) { return seen_.data() + rowIndex(y, z) * static_cast<std::size_t>(size_.x); }
  void runLevel(int y);
  void takeEnd(int y, int z);
  void takeStops(std::size_t crossed, int y, int z);
  void alongRow(int y, int z, Value* to) const;

  const Stops<Value>& stops_;
  Voxel size_, v_;
  std::vector<Voxel> crossed_;
  std::vector<std::uint8_t> faces_;
  Value open_;
  int slots_, last_ = 0;
  std::vector<Value> seen_;
  std::vector<std::uint8_t> filled_;  // rows in which anything but `open` may be seen
};

/// For every voxel that is no stop the sum of what it sees along the directions, times their weights, over
/// ExposureField::kWhole and rounded; 0 is seen where nothing stops a ray, and stops have 0. The weights must
/// add up to at most that. The same on any number of threads.
Field<std::uint16_t> carriedSum(const Stops<std::uint16_t>& stops, const DirectionSet& directions);

}  // namespace espalier::sim
