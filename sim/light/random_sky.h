#pragma once
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "sim/light/exposure.h"
#include "sim/light/sky.h"
#include "sim/world/field.h"

/// Greene's own sky (Voxel Space Automata, 1989), for comparison: rays from each voxel at random over
/// the hemisphere, evenly scattered by rejecting those that cluster. It errs at random from voxel to voxel
/// where a set of lattice directions errs smoothly, and costs a ray's whole length.
namespace espalier::sim {

struct RandomSky {
  int rays = 100;          ///< for each voxel, 1 to kMostSkyDirections
  std::uint64_t seed = 1;  ///< another seed, other rays
};

/// "100 random rays from each voxel, cosine-weighted view factor".
std::string describe(const RandomSky& sky, Weighting weighting);

/// The unit vectors drawn for a voxel: they follow from the voxel and the seed alone. None lies nearer to an
/// earlier one, or to the opposite of one, than randomSkySpacing(), unless 100 tries found no room. The
/// opposites close the hemisphere: without them the horizon, beyond which nothing crowds, would get more than
/// its share of the rays.
std::vector<Vec3> randomDirections(const RandomSky& sky, Voxel p);

/// The cosine of the angle below which a direction is rejected. Caps of half this angle about the directions
/// cover 40 % of the hemisphere; caps dropped at random find no more room at 55 %.
double randomSkySpacing(int rays);

/// What the rays see, weighted as level ground receives them; open ground sees 1. The rays cross the voxels
/// of Amanatides and Woo's traversal, with ties as in sim/tile/tiling.h. Throws InputError for a number of
/// rays that makes no sky.
Outlook lookOut(const BitVolume& occupied, Voxel p, const RandomSky& sky, Weighting weighting);

/// The same for the voxels of `where`, or for every voxel of the world if that is null.
ExposureField randomExposure(const BitVolume& occupied, const RandomSky& sky, Weighting weighting,
                             std::shared_ptr<const VoxelSet> where);

}  // namespace espalier::sim
