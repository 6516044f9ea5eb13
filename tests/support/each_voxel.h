#pragma once
#include "sim/base/vec.h"

namespace espalier::tests {

template <typename Work>
void forEachVoxel(sim::Voxel size, Work work) {
  for (int y = 0; y < size.y; ++y) {
    for (int z = 0; z < size.z; ++z) {
      for (int x = 0; x < size.x; ++x) work(sim::Voxel(x, y, z));
    }
  }
}

}  // namespace espalier::tests
