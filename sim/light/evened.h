#pragma once
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "sim/base/voxel_set.h"
#include "sim/world/world.h"

namespace espalier::sim {

/// What surfaces receive of the sky, evened over their neighbours. A sky of so many directions errs a little
/// at each place, by chance, and by another chance where the directions meet the edges of what stands there a
/// little farther along; so the mean over a surface errs less (docs/accuracy.md). Of neighbours up to two
/// voxels off in the same plane, with nothing between, opposite pairs count: what rises or falls evenly along
/// the surface keeps its value, at its edges too. A pair counts where it differs from the surface by no more
/// than chance makes it: shadows of what is near keep their edges. Equal values stay what they are, exactly.
///
/// `values` of `surfaces`, which `where` numbers; `standard_error` of the sky (sim/light/sky.h). The result
/// does not depend on the number of threads.
std::vector<float> evened(std::span<const float> values, std::span<const TiledVoxel> surfaces,
                          const VoxelSet& where, double standard_error);

/// The pairs of neighbours of some surfaces, for those who even several values of them.
class SurfacePairs {
 public:
  SurfacePairs(std::span<const TiledVoxel> surfaces, const VoxelSet& where);

  /// As above.
  std::vector<float> evened(std::span<const float> values, double standard_error) const;

 private:
  struct Pair {
    std::uint32_t one, other;
    float weight;
  };
  std::vector<Pair> pairs_;
  std::vector<std::size_t> first_;  // of each surface; and their number
};

}  // namespace espalier::sim
