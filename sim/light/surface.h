#pragma once
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "sim/light/sky.h"
#include "sim/light/sun.h"
#include "sim/sweep/open_table.h"
#include "sim/world/world.h"

/// The light that surfaces receive. A surface is judged from the free space in front of it: a ray from inside
/// a floor's voxel would run into the floor's next voxel, and even half a voxel before a slanting wall its
/// own stairs hide what lies low. So places are asked that stand clear of the surface, in two layers and
/// more, and a straight line through their answers is followed back to where the surface lies
/// (docs/accuracy.md).
namespace espalier::sim {

/// Surface voxels that can be lit, and the free places from which each is judged.
struct SurfaceSensors {
  struct Tap {
    std::uint32_t place;  ///< number in `places`
    float weight;  ///< those of one surface add up to 1; may be negative (extrapolation to the surface)
  };
  std::vector<TiledVoxel> surfaces;  ///< that have a normal and a free place in front, in the order that
                                     ///< was given
  std::shared_ptr<const VoxelSet> places;  ///< that taps read
  /// In pieces, as they were found: there are so many that they should not be in memory twice.
  std::vector<std::vector<Tap>> taps;
  struct Own {
    std::uint32_t piece, first, count;
  };
  std::vector<Own> own;  ///< which taps are each surface's

  std::span<const Tap> of(std::size_t surface) const {
    const Own& of_it = own[surface];
    return std::span(taps[of_it.piece]).subspan(of_it.first, of_it.count);
  }
};

/// All of a world's surfaces, in (y, z, x) order. What lies inside solids is none.
SurfaceSensors surfaceSensors(const World& world);

/// Some of them.
SurfaceSensors surfaceSensors(const World& world, std::vector<TiledVoxel> surfaces);

/// Whether any of a world's surfaces has a free place in front.
bool anyCanBeLit(const World& world);

/// What a surface with this unit normal gets of a sky that nothing hides but the ground and the surface's own
/// back: 1 facing up, 0 facing down; as sim::unobstructed, and for uniform 1 - tilt / pi, the lune before it.
double openSky(Weighting weighting, Vec3 normal);

/// For each surface what it receives of the sky (sim/light/sky.h) by its own normal, 0..1: openSky where
/// nothing stands in the way, exactly, and else the share of it that the open directions in front of the
/// surface bring. `open` must be of the sensors' places and the sky's directions; they may be those of a sky
/// mirrored below the horizon.
std::vector<float> surfaceSky(const SurfaceSensors& sensors, const OpenTable& open, const Sky& sky);

/// The same of the sun: the weighted fraction of its way that the surface sees, 0..1; a surface does not see
/// what lies behind it.
std::vector<float> surfaceSun(const SurfaceSensors& sensors, const OpenTable& open, const Sun& sun);

/// Hours of direct sun.
std::vector<float> surfaceSunHours(const SurfaceSensors& sensors, const OpenTable& open, const Sun& sun);

/// Both at once.
struct SunOnSurfaces {
  std::vector<float> shares, hours;
};
SunOnSurfaces sunOnSurfaces(const SurfaceSensors& sensors, const OpenTable& open, const Sun& sun);

}  // namespace espalier::sim
