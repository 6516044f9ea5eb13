#pragma once
#include <cstdint>
#include <vector>

#include "sim/vec.h"

/// Directions to the sky and to the sun. Every direction runs along a primitive integer vector, so that the
/// voxels which a ray crosses repeat with that vector as their period, wherever the ray starts.
namespace espalier::sim {

struct LatticeDirection {
  Voxel v{0, 1, 0};  ///< primitive, v.y >= 1, |component| <= kLongestComponent
  std::vector<Voxel>
      crossed;  ///< the voxels that a ray from the centre of voxel 0 crosses on its way to the centre
                ///< of voxel v, without the first and with the last (ties as in sim/tiling.h)
  std::uint16_t weight = 0;
};

inline constexpr int kLongestComponent = 63;  ///< a sweep reads at most a word to either side

/// Directions whose weights add up to ExposureField::kWhole. Empty where there is nothing to see (a sun that
/// never rises), and then every exposure is 0.
using DirectionSet = std::vector<LatticeDirection>;

enum class Weighting {
  uniform,  ///< by solid angle: every part of the sky counts alike (Greene's own)
  cosine    ///< times the cosine with the normal: the view factor
};

/// About `count` directions spread evenly over the hemisphere y > 0, each weighted by its share of the sky
/// (the part that is nearer to it than to any other). With cosine weighting, the share of what a surface with
/// this unit normal receives; directions behind it have no part.
DirectionSet skyDirections(int count, Weighting weighting = Weighting::uniform, Vec3 normal = Vec3(0, 1, 0));

/// Greene's sun: a half circle from horizon to horizon through a point `tilt_deg` from the zenith (0 <= tilt
/// < 90), leaning to the compass way `toward_deg` (0 = -z, 90 = +x, 180 = +z, 270 = -x); evenly sampled.
struct SunArc {
  double tilt_deg = 20.0;
  double toward_deg = 180.0;
  int samples = 48;
};

/// Unit direction to the sun at an hour of the day: 6 sunrise, 12 the top of the arc, 18 sunset.
Vec3 sunDirection(const SunArc& arc, double hour);
DirectionSet sunDirections(const SunArc& arc);

/// One direction with all the weight: a shadow matte.
DirectionSet singleDirection(Vec3 unit);

/// The primitive vector with v.y >= 1 and components up to `longest` whose direction is nearest to a unit
/// vector.
Voxel nearestLatticeVector(Vec3 unit, int longest);

/// Voxels crossed on one period of v: LatticeDirection::crossed.
std::vector<Voxel> crossedVoxels(Voxel v);

}  // namespace espalier::sim
