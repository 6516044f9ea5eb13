#include "sim/light/sky_in_space.h"

#include "sim/sweep/sweep.h"

namespace espalier::sim {

ExposureField skyInSpace(const BitVolume& opaque, const Sky& sky, const std::optional<RandomSky>& random_sky,
                         std::shared_ptr<const VoxelSet> where) {
  if (random_sky) return randomExposure(opaque, *random_sky, sky.weighting, std::move(where));
  return where ? sweepExposure(opaque, receivedBy(sky), std::move(where))
               : sweepExposure(opaque, receivedBy(sky));
}

}  // namespace espalier::sim
