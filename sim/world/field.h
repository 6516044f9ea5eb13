#pragma once
#include <cassert>
#include <cstdint>
#include <memory>
#include <vector>

#include "sim/base/frame.h"
#include "sim/base/vec.h"
#include "sim/base/voxel_set.h"

namespace espalier::sim {

/// A number for each voxel of a world, or for some of them.
template <typename T>
struct Field {
  Voxel size{0};
  std::vector<T> values;  ///< of every voxel, x fastest, then z, then y; or of those of `where`
  std::shared_ptr<const VoxelSet> where = nullptr;  ///< null: everywhere

  /// Of a voxel inside the world, and in `where` if that is given.
  std::size_t index(Voxel v) const {
    if (where) {
      assert(where->has(v));
      return where->number(v);
    }
    return (static_cast<std::size_t>(v.y) * static_cast<std::size_t>(size.z) +
            static_cast<std::size_t>(v.z)) *
               static_cast<std::size_t>(size.x) +
           static_cast<std::size_t>(v.x);
  }
};

/// A fraction for each voxel, 0..1, stored exactly as the whole-number sum of the weights of the directions
/// that reach the world's edge. kWhole is all that an unobstructed level place receives.
struct ExposureField : Field<std::uint16_t> {
  static constexpr std::uint16_t kWhole = 65535;

  /// 1 outside the world: nothing stands there.
  float at(Voxel v) const { return contains(size, v) ? static_cast<float>(values[index(v)]) / kWhole : 1.0f; }
};

}  // namespace espalier::sim
