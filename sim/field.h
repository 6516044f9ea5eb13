#pragma once
#include <cstdint>
#include <vector>

#include "sim/frame.h"
#include "sim/vec.h"

namespace espalier::sim {

/// A fraction for every voxel of a world, 0..1, stored exactly as the whole-number sum of the weights of the
/// directions that reach the world's edge. Directions' weights add up to kWhole.
struct ExposureField {
  static constexpr std::uint16_t kWhole = 65535;

  Voxel size{0};
  std::vector<std::uint16_t> sums;  ///< x fastest, then z, then y

  std::size_t index(Voxel v) const {
    return (static_cast<std::size_t>(v.y) * static_cast<std::size_t>(size.z) +
            static_cast<std::size_t>(v.z)) *
               static_cast<std::size_t>(size.x) +
           static_cast<std::size_t>(v.x);
  }
  /// 1 outside the world: nothing stands there.
  float at(Voxel v) const { return contains(size, v) ? static_cast<float>(sums[index(v)]) / kWhole : 1.0f; }
};

}  // namespace espalier::sim
