#pragma once
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "sim/base/bits.h"
#include "sim/sweep/directions.h"
#include "sim/world/field.h"

namespace espalier::sim {

/// True if a ray from the centre of voxel p along the direction reaches the world's edge; p itself does not
/// block. The voxels are those of Amanatides and Woo's traversal (1987), with ties as in sim/tile/tiling.h.
bool reachesEdge(const BitVolume& occupied, Voxel p, const LatticeDirection& direction);

/// What can be seen of the sky (or the sun's arc) from a voxel.
struct Outlook {
  std::uint16_t sum = 0;  ///< weights of the directions that reach the edge, as in ExposureField
  Vec3 toward{0.0};  ///< weighted sum of those directions: its way is the brightest (first moment of the sky)

  double fraction() const { return static_cast<double>(sum) / ExposureField::kWhole; }
};

/// Casts every ray of the set: the same sum as sweepExposure gives, for a few places.
Outlook lookOut(const BitVolume& occupied, Voxel p, const DirectionSet& directions);

/// What each of some directions gives where it alone is open.
std::vector<Outlook> sharesOf(const DirectionSet& directions);

/// The sum of those shares `first` .. first + count - 1 whose bits are set in `open`, in their order: what
/// lookOut gives, to the last bit.
Outlook outlook(std::span<const Outlook> shares, std::span<const std::uint64_t> open, std::size_t first,
                std::size_t count);

/// Directions made ready for looks into worlds of one shape, each ray still walked on its own: the same
/// answers as lookOut, several times as fast.
class Lookout {
 public:
  Lookout(const BitVolume& shape, const DirectionSet& directions);
  /// `occupied` must have the shape that was given.
  Outlook from(const BitVolume& occupied, Voxel p) const;

 private:
  struct Ray {
    Voxel v;
    std::uint16_t weight;
    Vec3 unit;
    std::size_t first, last;  ///< of its crossed voxels
  };
  std::vector<Ray> rays_;
  std::vector<Voxel> crossed_;
  std::vector<std::ptrdiff_t> steps_;  ///< to each of crossed_, in bits of the volume
};

}  // namespace espalier::sim
